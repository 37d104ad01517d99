#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

namespace kinetix::targets {

/// Calls visit(first, second), first < second, for each pair of segments whose ranges along one axis come within
/// `near` of each other. The axis is the one along which the points spread most. Segment k joins points k and k + 1.
/// The sweep along the axis takes n log n time for curves that do not crowd it.
/// @param points at least 2, finite, in any unit. @param near >= 0, in that unit
template <class Point, class Visit>
void for_segment_pairs(const std::vector<Point>& points, double near, const Visit& visit) {
  Point lowest = points[0], highest = points[0];
  for (const Point& p : points) {
    lowest = lowest.cwiseMin(p);
    highest = highest.cwiseMax(p);
  }
  int axis = 0;
  (highest - lowest).maxCoeff(&axis);
  const auto low = [&](int k) { return std::min(points[k][axis], points[k + 1][axis]); };
  const auto high = [&](int k) { return std::max(points[k][axis], points[k + 1][axis]); };
  std::vector<int> order(points.size() - 1), active;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) < low(b); });
  for (const int k : order) {
    std::erase_if(active, [&](int a) { return high(a) < low(k) - near; });
    for (const int a : active) visit(std::min(a, k), std::max(a, k));
    active.push_back(k);
  }
}

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
