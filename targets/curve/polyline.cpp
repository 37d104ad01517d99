#include "targets/curve/polyline.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/BVH>

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

/// Left normal at a closest point; at a corner the mean of both segments' normals decides the side.
Vector2d left_normal(const std::vector<Vector2d>& points, const ClosestPoint& closest) {
  const auto normal = [&](int k) { return left_of(points[k + 1] - points[k]).normalized(); };
  const int last = static_cast<int>(points.size()) - 2;
  if (closest.fraction == 1 && closest.segment < last)
    return normal(closest.segment) + normal(closest.segment + 1);
  if (closest.fraction == 0 && closest.segment > 0)
    return normal(closest.segment) + normal(closest.segment - 1);
  return normal(closest.segment);
}

void add_side(const std::vector<Vector2d>& points, const Vector2d& p, ClosestPoint& closest) {
  const Vector2d left = left_normal(points, closest), offset = p - closest.point;
  const double size = offset.norm(), side = offset.dot(left) < 0 ? -1 : 1;
  closest.distance = side * size;
  const bool on_the_line = !(size > 1e-12 * (points[closest.segment + 1] - points[closest.segment]).norm());
  closest.normal = on_the_line ? left.normalized() : Vector2d(side / size * offset);
}

/// ClosestPoint without side: distance is unsigned, normal not set.
ClosestPoint plain_closest_point(const std::vector<Vector2d>& points, int k, const Vector2d& p) {
  const Vector2d along = points[k + 1] - points[k];
  ClosestPoint closest;
  closest.segment = k;
  closest.fraction = fraction_along(points[k], along, p);
  closest.point = points[k] + closest.fraction * along;
  closest.distance = (p - closest.point).norm();
  return closest;
}

}  // namespace

ClosestPoint closest_on_segment(const std::vector<Vector2d>& points, int k, const Vector2d& p) {
  ClosestPoint closest = plain_closest_point(points, k, p);
  add_side(points, p, closest);
  return closest;
}

ClosestPoint closest_near(const std::vector<Vector2d>& points, int start, const Vector2d& p) {
  const int last = static_cast<int>(points.size()) - 2;
  ClosestPoint best = plain_closest_point(points, std::clamp(start, 0, last), p);
  for (const int step : {1, -1}) {
    for (int k = best.segment + step; k >= 0 && k <= last; k += step) {
      const ClosestPoint next = plain_closest_point(points, k, p);
      if (!(next.distance < best.distance)) break;
      best = next;
    }
  }
  add_side(points, p, best);
  return best;
}

namespace {

using Box = Eigen::AlignedBox2d;

struct NearestQuery {
  using Scalar = double;
  const std::vector<Eigen::Vector2d>& points;
  Eigen::Vector2d p;
  int best = 0;
  double best_squared = std::numeric_limits<double>::infinity();

  double minimumOnVolume(const Box& box) const { return box.squaredExteriorDistance(p); }
  double minimumOnObject(int k) {
    const Eigen::Vector2d along = points[k + 1] - points[k];
    const double f = fraction_along(points[k], along, p);
    const double squared = (p - points[k] - f * along).squaredNorm();
    if (squared < best_squared || (squared == best_squared && k < best)) {
      best_squared = squared;
      best = k;
    }
    return squared;
  }
};

}  // namespace

struct PolylineTree::Tree {
  Eigen::KdBVH<double, 2, int> bvh;
};

PolylineTree::PolylineTree(std::vector<Eigen::Vector2d> points)
    : points_(std::move(points)), tree_(std::make_unique<Tree>()) {
  std::vector<int> segments(points_.size() - 1);
  std::iota(segments.begin(), segments.end(), 0);
  std::vector<Box> boxes;
  for (const int k : segments) boxes.push_back(Box(points_[k]).extend(points_[k + 1]));
  tree_->bvh.init(segments.begin(), segments.end(), boxes.begin(), boxes.end());
}

PolylineTree::~PolylineTree() = default;
PolylineTree::PolylineTree(PolylineTree&&) noexcept = default;
PolylineTree& PolylineTree::operator=(PolylineTree&&) noexcept = default;

ClosestPoint PolylineTree::nearest(const Eigen::Vector2d& p) const {
  NearestQuery query{points_, p};
  Eigen::BVMinimize(tree_->bvh, query);
  return closest_on_segment(points_, query.best, p);
}

}  // namespace kinetix::targets
