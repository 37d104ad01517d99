#pragma once

#include <stop_token>

#include "app/run/run.hpp"
#include "model/lattice/lattice.hpp"
#include "model/matter/process.hpp"

namespace kinetix::app {

/// By how much every wall of a print may stand out of where the design has it, mm: three standard deviations of its place,
/// and of its tilt at the corner that is farthest from the body's vertex. 997 of 1000 walls keep each.
double print_growth_mm(const model::Linkage& sheet, const model::PrintError& sd);

/// Along the plan's closed form; where there is none, why nothing is certified. Equilibria of elastic hinges come near the
/// closed form and are not on it: what is proven of it is not proven of them. @param threads 0 = all cores
/// @param stop when requested, nothing is certified
ProvenRanges certify(const model::Lattice& sheet, const Plan& plan, const model::PrintError& sd, int threads,
                     const std::stop_token& stop);
/// Of a sheet alone, as files are checked: of its closed form, on all cores.
ProvenRanges certify(const model::Lattice& sheet, const model::PrintError& sd);

}  // namespace kinetix::app
