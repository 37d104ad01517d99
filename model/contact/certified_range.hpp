#pragma once

#include <stop_token>

#include "model/contact/wall_contact.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

struct CertifiedOptions {
  double limit = pi / 2;      ///< rad, (0, pi/2]; end of the search
  double precision = 1e-7;    ///< rad, >= 1e-12: unproven intervals are halved down to it
  double growth_mm = 0;       ///< growth of every plate on all sides relative to the design, >= 0
  std::stop_token stop = {};  ///< if it requests a stop, nothing is certified
  /// Per side of flat, > 0: reached by plates that slide along each other within rounding
  int max_states = 200000;

  /// @throws InvalidInput
  void validate() const;
};

/// Computes the collision-free range of theta to both sides of flat, proven by bounds. In no state of the range do
/// two plates touch that WallContact examines, including states between samples.
///
/// An interval of theta is proven for a pair of plates if the gap in its middle exceeds the loss of gap by the
/// motion, both along one direction. The loss has two parts: the twist in the middle times the half width,
/// exactly, and a bound of the second derivative over the interval (SweptMotion). The bound follows from the hinges
/// between the two bodies and their laws (TurnLaw). Unproven intervals are halved. The margin is a billionth of the
/// cell edge for rounding, plus the misfit of the state at its hinges times the number of hinges between the bodies.
///
/// @param exact the states   @param turns law of each hinge in these states; if a state differs, nothing is certified
/// @throws InvalidInput for options out of range
ContactRange certified_range(const Linkage& structure, const ExactMotion& exact,
                             const std::vector<TurnLaw>& turns, const CertifiedOptions& options = {});

}  // namespace kinetix::model
