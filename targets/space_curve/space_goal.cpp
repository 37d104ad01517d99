#include "targets/space_curve/space_goal.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/base/box_of.hpp"
#include "targets/curve/polyline_checks.hpp"
#include "targets/curve/segment_pairs.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

constexpr double back_cosine = -0.98481;  // of 170 degrees: no strip turns so far at one point

void check_turns(const std::vector<Vector3d>& points) {
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const Vector3d before = (points[k] - points[k - 1]).normalized(),
                   after = (points[k + 1] - points[k]).normalized();
    if (!(before.dot(after) > back_cosine)) throw turns_back(k);
  }
}

void check_meeting(const std::vector<Vector3d>& points, double near) {
  for_segment_pairs(points, near, [&](int first, int second) {
    if (second == first + 1) return;
    if (!(segment_distance(points[first], points[first + 1], points[second], points[second + 1]) > near))
      throw crosses_itself(first, second, false);
  });
}

std::vector<Vector3d> checked(std::vector<Vector3d> points, double& diagonal) {
  check_points(points);
  check_open(points);
  diagonal = model::box_of(points).diagonal().norm();
  check_turns(points);
  check_meeting(points, touching * diagonal);
  return points;
}

}  // namespace

// Ericson, Real-Time Collision Detection, section 5.1.9.
double segment_distance(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double denominator = uu * vv - uv * uv;
  double s = denominator > 0 ? std::clamp((uv * vw - uw * vv) / denominator, 0.0, 1.0) : 0;
  const double t = std::clamp((uv * s + vw) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  return (w + s * u - t * v).norm();
}

SpaceGoal::SpaceGoal(std::vector<Vector3d> points) : line_(checked(std::move(points), diagonal_)) {}

}  // namespace kinetix::targets
