#include "targets/space_curve/space_goal.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "targets/curve/polyline_checks.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

constexpr double touching = 1e-9;         // of the diagonal: closer parts meet, but for rounding
constexpr double back_cosine = -0.98481;  // of 170 degrees: no strip turns so far at one point

std::string number(std::size_t k) { return std::to_string(k + 1); }

void check_each(const std::vector<Vector3d>& points) {
  if (points.size() < 3)
    throw InvalidCurve("a curve needs at least 3 points, this one has " + std::to_string(points.size()), -1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite())
      throw InvalidCurve("point " + number(k) + " is not a finite number", static_cast<int>(k));
    if (k > 0 && !((points[k] - points[k - 1]).norm() > 0)) throw repeated_point(k);
  }
  if (points.front() == points.back())
    throw InvalidCurve("the curve is closed (its last point is its first); a strip needs an open curve",
                       static_cast<int>(points.size()) - 1);
}

void check_turns(const std::vector<Vector3d>& points) {
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const Vector3d before = (points[k] - points[k - 1]).normalized(),
                   after = (points[k + 1] - points[k]).normalized();
    if (!(before.dot(after) > back_cosine))
      throw InvalidCurve("the curve turns back on itself at point " + number(k), static_cast<int>(k));
  }
}

double diagonal_of(const std::vector<Vector3d>& points, int& longest) {
  Vector3d low = points[0], high = points[0];
  for (const Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  (high - low).maxCoeff(&longest);
  return (high - low).norm();
}

// Sweep along the longest axis: segments are compared only where their ranges overlap.
void check_meeting(const std::vector<Vector3d>& points, double near, int axis) {
  const int segments = static_cast<int>(points.size()) - 1;
  const auto low = [&](int k) { return std::min(points[k][axis], points[k + 1][axis]); };
  const auto high = [&](int k) { return std::max(points[k][axis], points[k + 1][axis]); };
  std::vector<int> order(segments), active;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) < low(b); });
  for (const int k : order) {
    std::erase_if(active, [&](int a) { return high(a) < low(k) - near; });
    for (const int a : active) {
      const auto [first, second] = std::minmax(a, k);
      if (second == first + 1) continue;
      if (segment_distance(points[a], points[a + 1], points[k], points[k + 1]) > near) continue;
      throw InvalidCurve("the curve crosses itself: segment " + number(first) + "-" + number(first + 1) +
                             " meets segment " + number(second) + "-" + number(second + 1),
                         second);
    }
    active.push_back(k);
  }
}

std::vector<Vector3d> checked(std::vector<Vector3d> points, double& diagonal) {
  check_each(points);
  int longest = 0;
  diagonal = diagonal_of(points, longest);
  check_turns(points);
  check_meeting(points, touching * diagonal, longest);
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
