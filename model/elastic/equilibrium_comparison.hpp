#pragma once

#include <cmath>
#include <string>

#include "model/hinge/elasticity.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A structure with elastic hinges at the end of its drive.
struct EquilibriumScene {
  Linkage structure;
  Elasticity elasticity;
  LinkageDrive drive;
  bool planar = false;
  bool contact = true;
};

/// How a state that some other method found compares with an equilibrium of the same structure and drive.
///
/// Sheets that buckle, jam or snap have several equilibria. Where two states differ, the energy is minimised
/// from the one in question: if that ends nearby, and not at the reference, both are equilibria.
struct EquilibriumComparison {
  enum class Outcome {
    agrees,          ///< the states are within the tolerance
    another_branch,  ///< they are not, and a stable equilibrium is within the tolerance of the state
    disagrees,       ///< they are not, and no other equilibrium is near the state
  };

  Outcome outcome = Outcome::disagrees;
  std::string why;         ///< the outcome in words, with its numbers
  StateDistance distance;  ///< of state and reference
  /// Of the state from the equilibrium that minimising it leads to; NaN where to none.
  StateDistance from_equilibrium{std::nan(""), std::nan("")};
  double energy = std::nan("");  ///< N mm, of that equilibrium; NaN where there is none
  double reference_energy = 0;   ///< N mm
};

std::string to_string(EquilibriumComparison::Outcome outcome);

/// @param tolerance of rms distances, cell edges
/// @pre both states are finite
EquilibriumComparison compare_equilibria(const EquilibriumScene& scene, const State& state,
                                         const State& reference, double tolerance);

}  // namespace kinetix::model
