#pragma once

#include <vector>

#include "model/contact/linkage_motion.hpp"
#include "model/contact/wall_contact.hpp"

namespace kinetix::model {

/// What of a linkage stays the same from state to state, for proofs that its plates stay apart.
struct LinkagePlates : LinkageMotion {
  /// @param structure kept by reference   @param turns one a hinge   @param growth_mm of every plate, on all its sides
  LinkagePlates(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm);

  /// Whether they are to be looked at: not of one wall, and not touching at rest. @pre of two bodies
  bool can_touch(const WallPair& pair) const;

  std::vector<HalfWall> walls;              ///< grown
  WallContact at_rest;                      ///< not grown
  std::vector<std::vector<int>> plates_of;  ///< each body
  std::vector<double> reach;                ///< of each body's plates from its vertex, mm
};

}  // namespace kinetix::model
