#pragma once

#include <stop_token>
#include <vector>

#include "model/contact/wall_contact.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::model {

struct CertifiedOptions {
  double limit = pi / 2;      ///< rad, (0, pi/2]; where to stop
  double precision = 1e-7;    ///< rad, >= 1e-12: intervals that are not proven are halved down to it
  double growth_mm = 0;       ///< by which every plate is larger on all its sides than designed, >= 0
  std::stop_token stop = {};  ///< where it asks to, nothing is certified
  int most_states = 200000;  ///< on a side, > 0: plates that slide along each other within rounding end there

  /// @throws InvalidInput
  void validate() const;
};

/// Proves by bounds how far a structure folds to both sides of flat before walls collide: in no state of the range do two
/// plates touch that WallContact looks at, whatever lies between samples.
///
/// An interval of theta is proven for a pair of plates where the gap along one direction, in the middle of the interval,
/// exceeds what the motion may take of it: the twist in the middle times the half width, exactly, and a bound of the second
/// derivative over the interval (SweptMotion), which follows from the hinges on the way from one body to the other and how
/// they turn (TurnLaw). What is not proven is halved. The margin for rounding is a billionth of the cell edge, and what
/// the state leaves open at its hinges, times those on the way.
///
/// @param exact the states   @param turns how each hinge turns along them; where a state differs, nothing is certified
/// @throws InvalidInput for options out of range
ContactRange certified_range(const Linkage& structure, const ExactMotion& exact,
                             const std::vector<TurnLaw>& turns, const CertifiedOptions& options = {});

}  // namespace kinetix::model
