#pragma once

#include <cmath>

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/unit_laws.hpp"

namespace kinetix::model {

/// Returns the drive that turns a wall so that its structure folds to theta, rad.
inline Drive hinge_drive(const Structure& s, const Wall& wall, double theta) {
  return hinge_drive_to(s, wall, theta);
}

}  // namespace kinetix::model

/// Shorthand for equilibrium runs against closed forms.
namespace kinetix::testing {

using model::hinge_drive;

inline model::EquilibriumPathOptions without_contact() {
  model::EquilibriumPathOptions options;
  options.contact = false;
  return options;
}

inline model::Drive plates_drive(model::Axis axis, double theta) {
  return model::Plates{.axis = axis, .compression = 1 - std::cos(theta), .branch = theta < 0 ? -1 : 1};
}

/// Returns the rms distance of a state from the closed form at theta, cell edges.
inline double from_closed_form(const model::Structure& s, const model::State& state, double theta) {
  return aligned_distance(s, state, fold(classify(s), s, theta)).rms;
}

inline double from_closed_form(const model::Structure& s, const model::EquilibriumPath& path) {
  return from_closed_form(s, path.state, path.theta);
}

/// Returns the energy of the turning springs if all hinges turn by twice theta, N mm.
inline double planar_energy(const model::Structure& s, double k_turn, double theta) {
  return static_cast<double>(s.hinges.size()) * 2 * k_turn * theta * theta;
}

/// Returns the number of cells from which a strip tips over between its plates instead of folding. It is keyed upright
/// in the middle only. A column folded to theta stores 6 k_turn theta^2, so tipping it by phi gains 6 k_turn phi^2.
/// Twisting it against the next by tau costs 3 k_point reach^2 tau^2 in three hinges. This is Euler's column, clamped
/// in the middle and free at its ends.
inline double tipping_length(const model::Elasticity& e) {
  return pi * e.reach_mm * std::sqrt(e.k_point / (2 * e.k_turn));
}

inline const model::PathEvent* first_event(const model::EquilibriumPath& path, model::PathEvent::Kind kind) {
  for (const model::PathEvent& event : path.events)
    if (event.kind == kind) return &event;
  return nullptr;
}

}  // namespace kinetix::testing
