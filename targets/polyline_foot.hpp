#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix {

/// The place of a polyline nearest to a point.
struct Foot {
  int segment = 0;
  double fraction = 0;  ///< along the segment, [0, 1]
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  double distance = 0;  ///< mm, > 0 left of the polyline, < 0 right of it
  /// Gradient of the signed distance with respect to the point: a unit vector.
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();
};

/// Nearest place on one segment k of the polyline. @pre 0 <= k < points.size() - 1
Foot foot_on_segment(const std::vector<Eigen::Vector2d>& points, int k, const Eigen::Vector2d& p);

/// Nearest place reached by walking downhill from segment `start`: the foot that continues a known
/// correspondence, even where another part of the curve passes closer.
Foot foot_near(const std::vector<Eigen::Vector2d>& points, int start, const Eigen::Vector2d& p);

}  // namespace kinetix
