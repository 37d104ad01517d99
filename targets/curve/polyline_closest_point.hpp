#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace kinetix::targets {

/// The vector turned by a quarter turn to the left.
inline Eigen::Vector2d left_of(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The place of a polyline nearest to a point. Points here are in mm, as those of a Curve.
struct ClosestPoint {
  int segment = 0;
  double fraction = 0;                              ///< along the segment, [0, 1]
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< mm
  double distance = 0;                              ///< mm, > 0 left of the polyline, < 0 right of it
  /// Gradient of the signed distance with respect to the point: a unit vector.
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();
};

/// Fraction [0, 1] of the segment from `start` over `along` (not zero) at which it comes nearest to p.
inline double fraction_along(const Eigen::Vector2d& start, const Eigen::Vector2d& along,
                             const Eigen::Vector2d& p) {
  return std::clamp((p - start).dot(along) / along.squaredNorm(), 0.0, 1.0);
}

/// Nearest place on one segment k of the polyline. @pre 0 <= k < points.size() - 1
ClosestPoint closest_on_segment(const std::vector<Eigen::Vector2d>& points, int k, const Eigen::Vector2d& p);

/// Nearest place reached by walking downhill from segment `start`: the closest point that continues a known
/// correspondence, even where another part of the curve passes closer.
ClosestPoint closest_near(const std::vector<Eigen::Vector2d>& points, int start, const Eigen::Vector2d& p);

}  // namespace kinetix::targets
