#include "targets/curve/polyline_tree.hpp"

#include <Eigen/Geometry>
#include <limits>
#include <numeric>
#include <unsupported/Eigen/BVH>

namespace kinetix::targets {
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
