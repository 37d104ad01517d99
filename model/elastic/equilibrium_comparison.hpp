#pragma once

#include <cmath>

#include "model/hinge/elasticity.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Structure with elastic hinges at the end of its drive.
struct EquilibriumScene {
  Linkage structure;
  Elasticity elasticity;
  LinkageDrive drive;
  bool planar = false;
  bool contact = true;
};

/// Comparison of a state from another method with an equilibrium of the same structure and drive.
///
/// Sheets that buckle, jam or snap have several equilibria. If two states differ, the energy is minimised
/// from the state in question. If this ends nearby, and not at the reference, both are equilibria.
struct EquilibriumComparison {
  enum class Outcome {
    agrees,          ///< the states are within the tolerance
    another_branch,  ///< they are not, and a stable equilibrium is within the tolerance of the state
    disagrees,       ///< they are not, and no other equilibrium is near the state
  };

  Outcome outcome = Outcome::disagrees;
  std::string why;         ///< the outcome in words, with its numbers
  StateDistance distance;  ///< between state and reference
  /// Distance of the state from the equilibrium that minimisation finds; NaN if it finds none.
  StateDistance from_equilibrium{std::nan(""), std::nan("")};
  double energy = std::nan("");  ///< N mm, of that equilibrium; NaN if there is none
  double reference_energy = 0;   ///< N mm
};

std::string to_string(EquilibriumComparison::Outcome outcome);

/// Compares two states. @param tolerance of rms distances, cell edges
/// @pre both states are finite
EquilibriumComparison compare_equilibria(const EquilibriumScene& scene, const State& state,
                                         const State& reference, double tolerance);

}  // namespace kinetix::model
