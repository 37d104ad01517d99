#pragma once

#include <vector>

#include "model/contact/linkage_motion.hpp"
#include "model/contact/wall_contact.hpp"

namespace kinetix::model {

/// Data of a linkage common to all states, for proofs that its plates stay apart.
struct LinkagePlates : LinkageMotion {
  /// @param structure kept by reference   @param turns one per hinge   @param growth_mm growth of every plate on all
  /// sides
  LinkagePlates(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm);

  /// Returns true if a pair must be examined: not of one wall, and not touching at rest. @pre plates of two bodies
  bool can_touch(const WallPair& pair) const;

  std::vector<HalfWall> walls;              ///< with growth
  WallContact at_rest;                      ///< without growth
  std::vector<std::vector<int>> plates_of;  ///< plates of each body
  std::vector<double> reach;                ///< largest distance of each body's plates from its vertex, mm
};

}  // namespace kinetix::model
