#pragma once

#include <Eigen/Geometry>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Bound of how much closer bodies may be than in a remembered state. The homogeneous strain that all bodies
/// share reduces distances in proportion. The remaining motion is compared between tiles of the remembered
/// state, so that parts of a large sheet that move apart do not count as closer.
class RelativeMotion {
 public:
  /// @param edge_mm cell edge   @param reach largest distance of a body's points from its origin, cell edges
  RelativeMotion(double edge_mm, double reach) : edge_mm_(edge_mm), reach_(reach) {}

  /// @pre finite
  void remember(const State& state);
  /// Returns whether all points of two bodies that were apart by `margin` (cell edges) or more are certain
  /// not to touch now. False if no state with as many bodies is remembered, and for states that are not
  /// finite.
  bool keeps_apart(const State& state, double margin) const;

 private:
  struct Tile {
    Eigen::AlignedBox3d box;  ///< around the origins of its bodies, cell edges
    std::vector<int> bodies;
  };
  /// Motion of a tile beyond the homogeneous strain, cell edges.
  struct Motion {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< mean of its bodies
    double spread = 0;  ///< largest deviation from `shift` of any point of its bodies
  };

  std::vector<Motion> motions(const State& state, const Eigen::Matrix3d& strain) const;

  const double edge_mm_, reach_;
  State state_;
  std::vector<Tile> tiles_;
};

}  // namespace kinetix::model
