#pragma once

#include <stop_token>

#include "app/run/run.hpp"
#include "model/lattice/lattice.hpp"
#include "model/matter/process.hpp"

namespace kinetix::app {

/// Returns by how much a wall of a print may project from its place in the design, mm. It is the sum of three
/// standard deviations of its place and of its tilt at the corner farthest from the body's vertex. 997 of 1000 walls
/// stay within each.
double print_growth_mm(const model::Linkage& sheet, const model::PrintError& sd);

/// Computes the collision-free range of theta along the plan's closed form (continuous collision check). Without a
/// closed form the result says why nothing is proven. Equilibria of elastic hinges lie near the closed form, not on
/// it, so the proof does not cover them. @param threads 0 = all cores
/// @param stop when requested, nothing is proven
ProvenRanges certify(const model::Lattice& sheet, const Plan& plan, const model::PrintError& sd, int threads,
                     const std::stop_token& stop);
/// Computes the collision-free range of a sheet alone, as file checks need it: along its closed form, on all cores.
ProvenRanges certify(const model::Lattice& sheet, const model::PrintError& sd);

}  // namespace kinetix::app
