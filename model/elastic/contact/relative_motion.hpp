#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// How far bodies may have come closer to each other since a state that is remembered. What all of them share, a homogeneous
/// strain, brings two closer by a part of their distance. What is left is compared tile by tile of the remembered state: parts
/// of a large sheet that move apart from each other do not touch for that.
class RelativeMotion {
 public:
  /// @param edge_mm cell edge  @param reach of what a body carries, from its origin, cell edges
  RelativeMotion(double edge_mm, double reach) : edge_mm_(edge_mm), reach_(reach) {}

  /// @pre finite
  void remember(const State& state);
  /// Whether nothing that two bodies carry can touch now that was apart by `margin` (cell edges) or more, or further away than
  /// that and both reaches. False where no state of as many bodies is remembered, and for states that are not finite.
  bool keeps_apart(const State& state, double margin) const;

 private:
  struct Tile {
    Eigen::AlignedBox3d box;  ///< around the origins of its bodies, cell edges
    std::vector<int> bodies;
  };
  /// What a tile did beyond the homogeneous strain, cell edges.
  struct Motion {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< mean of its bodies
    double spread = 0;  ///< of anything that one of its bodies carries, from that, at most
  };

  std::vector<Motion> motions(const State& state, const Eigen::Matrix3d& strain) const;

  const double edge_mm_, reach_;
  State state_;
  std::vector<Tile> tiles_;
};

}  // namespace kinetix::model
