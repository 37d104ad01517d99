#pragma once

#include <memory>
#include <vector>

#include "targets/curve/polyline_closest_point.hpp"

namespace kinetix::targets {

/// Finds the nearest place on a whole polyline in O(log segments) per query. Points in mm.
class PolylineTree {
 public:
  /// @pre at least two points, all finite
  explicit PolylineTree(std::vector<Eigen::Vector2d> points);
  ~PolylineTree();
  PolylineTree(PolylineTree&&) noexcept;
  PolylineTree& operator=(PolylineTree&&) noexcept;

  ClosestPoint nearest(const Eigen::Vector2d& p) const;
  const std::vector<Eigen::Vector2d>& points() const { return points_; }

 private:
  struct Tree;
  std::vector<Eigen::Vector2d> points_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace kinetix::targets
