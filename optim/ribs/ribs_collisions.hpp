#pragma once

#include <string>
#include <vector>

#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/fishbone.hpp"
#include "model/linkage/half_wall.hpp"

namespace kinetix::optim {

/// Walls of a fishbone that collide while it folds, checked in sixteen states from flat to theta.
class RibsCollisions {
 public:
  /// @param fishbone with its tilts   @param theta rad
  RibsCollisions(const model::Fishbone& fishbone, double theta);

  /// Shortens one rib of each pair of walls, unless both are on the same side of one rib.
  /// @return number of removed cells
  int trim(model::FishboneLayout& spine_and_ribs) const;
  /// Names the first three pairs and counts the others; empty if none collide.
  std::vector<std::string> in_words() const;

 private:
  const model::FishbonePlace& place_of_plate(int half) const { return places_[walls_[half].body]; }

  std::vector<model::HalfWall> walls_;
  std::vector<model::FishbonePlace> places_;  // of each body
  std::vector<model::WallPair> pairs_;
  std::vector<std::string> names_;  // of each hinge's wall
};

}  // namespace kinetix::optim
