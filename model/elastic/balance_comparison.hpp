#pragma once

#include <cmath>
#include <string>

#include "model/drive.hpp"
#include "model/elastic/elasticity.hpp"
#include "model/state.hpp"

namespace kinetix {

/// A structure with elastic hinges at the end of its drive.
struct BalanceScene {
  const Structure& structure;
  Elasticity elasticity;
  Drive drive;
  bool planar = false;
  bool contact = true;
};

/// How a state that some other method found compares with a balance of the same structure and drive.
///
/// Sheets that buckle, jam or snap have several balances. Where two states differ, the energy is minimised
/// from the one in question: if that ends nearby, and not at the reference, both are balances.
struct BalanceComparison {
  enum class Outcome {
    agrees,          ///< the states are within the tolerance
    another_branch,  ///< they are not, and a stable balance is within the tolerance of the state
    disagrees,       ///< they are not, and no other balance is near the state
  };

  Outcome outcome = Outcome::disagrees;
  std::string why;         ///< the outcome in words, with its numbers
  StateDistance distance;  ///< of state and reference
  /// Of the state from the balance that minimising it leads to; NaN where to none.
  StateDistance from_balance{std::nan(""), std::nan("")};
  double energy = std::nan("");  ///< N mm, of that balance; NaN where there is none
  double reference_energy = 0;   ///< N mm
};

std::string to_string(BalanceComparison::Outcome outcome);

/// @param tolerance of rms distances, cell edges
/// @pre both states are finite
BalanceComparison compare_balances(const BalanceScene& scene, const State& state, const State& reference,
                                   double tolerance);

}  // namespace kinetix
