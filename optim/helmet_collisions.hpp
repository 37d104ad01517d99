#pragma once

#include <string>
#include <vector>

#include "model/fishbone.hpp"
#include "model/half_wall.hpp"
#include "model/wall_contact.hpp"

namespace kinetix {

/// Walls of a fishbone that run into each other while it folds, looked at in sixteen states from flat to
/// theta.
class HelmetCollisions {
 public:
  /// @param fishbone with its tilts   @param theta rad
  HelmetCollisions(const Fishbone& fishbone, double theta);

  /// Shortens one rib of each pair of walls that are not of the same side of one rib. @return cells taken
  int trim(FishboneLayout& bones) const;
  /// The first three pairs by name, and how many more there are; empty where none meet.
  std::vector<std::string> in_words() const;

 private:
  /// Which rib and side a body belongs to, and how many cells beyond the spine it is; rib -1 on the spine.
  struct Seat {
    int rib = -1, side = 0, cells = 0;
  };

  Seat seat(int half) const;

  const FishboneLayout layout_;
  int spine_column_;
  std::vector<HalfWall> walls_;
  std::vector<Vertex> bodies_;
  std::vector<WallPair> pairs_;
  std::vector<std::string> names_;  // of each hinge's wall
};

}  // namespace kinetix
