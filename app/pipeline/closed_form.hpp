#pragma once

#include "app/files/design_file.hpp"
#include "app/run/plan.hpp"
#include "app/run/run.hpp"
#include "model/lattice/lattice.hpp"
#include "model/material/process.hpp"

namespace kinetix::app {

/// Approximate number of states that show a motion, flat and last included: enough to see it move. Each state adds
/// all its poses to result.json.
inline constexpr int motion_states = 13;

/// Returns the state of an exact family at theta, rad, in the place where results show it. @param name of the state
/// @pre planned, exact
NamedState exact_state(const SearchResult& found, const std::string& name, double theta);

/// Returns motion_states states of the exact motion from flat to found.theta, rad.
std::vector<NamedState> exact_frames(const SearchResult& found);

/// Returns the table row of the exact model: time of one state, s, and as its error the largest joint separation,
/// cell edges.
/// @param theta rad
Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta);

/// Returns the model that computes the states of a design, from the requested model. Empty: exact if a family fits,
/// otherwise bullet. Imported bodies use the requested model. A simulation of elastic hinges is compared with their
/// equilibrium.
std::optional<Model> plan_model(const Design& design, Model asked);

/// Forecasts a run of a design.
Forecast forecast_design(const Design& design);

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
