#include "targets/curve/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Do the closed segments ab and cd share a point?
bool touch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    const double area = cross(q - p, r - p);
    return (area > 0) - (area < 0);
  };
  const auto between = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    return std::min(p.x(), q.x()) <= r.x() && r.x() <= std::max(p.x(), q.x()) &&
           std::min(p.y(), q.y()) <= r.y() && r.y() <= std::max(p.y(), q.y());
  };
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc != abd && cda != cdb) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

std::string number(std::size_t k) { return std::to_string(k + 1); }

InvalidCurve repeated_point(std::size_t k) {
  return InvalidCurve(
      "points " + number(k - 1) + " and " + number(k) + " are the same; every point must be new",
      static_cast<int>(k));
}

void check_points(const std::vector<Vector2d>& points) {
  if (points.size() < 3)
    throw InvalidCurve("a curve needs at least 3 points, this one has " + std::to_string(points.size()), -1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite())
      throw InvalidCurve("point " + number(k) + " is not a finite number", static_cast<int>(k));
    if (k > 0 && (points[k] - points[k - 1]).norm() == 0) throw repeated_point(k);
  }
  if (points.front() == points.back())
    throw InvalidCurve("the curve is closed (its last point is its first); a strip needs an open curve",
                       static_cast<int>(points.size()) - 1);
}

/// 0 or 1: the axis along which the points spread more.
int longer_axis(const std::vector<Vector2d>& points) {
  Vector2d low = points[0], high = points[0];
  for (const Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
}

/// Sweep along the longer axis: segments are compared only where their ranges overlap.
void check_crossing(const std::vector<Vector2d>& points) {
  const int segments = static_cast<int>(points.size()) - 1;
  const int axis = longer_axis(points);
  const auto low = [&](int k) { return std::min(points[k][axis], points[k + 1][axis]); };
  const auto high = [&](int k) { return std::max(points[k][axis], points[k + 1][axis]); };
  std::vector<int> order(segments), active;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a) < low(b); });
  for (const int k : order) {
    std::erase_if(active, [&](int a) { return high(a) < low(k); });
    for (const int a : active) {
      const auto [first, second] = std::minmax(a, k);
      if (second == first + 1) {
        const Vector2d u = points[first + 1] - points[first], v = points[second + 1] - points[second];
        if (cross(u, v) == 0 && u.dot(v) < 0)
          throw InvalidCurve("the curve turns back on itself at point " + number(second), second);
      } else if (touch(points[a], points[a + 1], points[k], points[k + 1])) {
        throw InvalidCurve("the curve crosses itself: segment " + number(first) + "-" + number(first + 1) +
                               " meets segment " + number(second) + "-" + number(second + 1),
                           second);
      }
    }
    active.push_back(k);
  }
}

}  // namespace

Curve::Curve(std::vector<Vector2d> points) : points_(std::move(points)) {
  check_points(points_);
  check_crossing(points_);
  Vector2d low = points_[0], high = points_[0];
  arc_.push_back(0);
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const Vector2d step = points_[k] - points_[k - 1];
    arc_.push_back(arc_.back() + step.norm());
    if (!(arc_[k] > arc_[k - 1])) throw repeated_point(k);
    const double heading = std::atan2(step.y(), step.x());
    const double before = k == 1 ? heading : heading_.back();
    heading_.push_back(before + std::remainder(heading - before, 2 * std::numbers::pi));
    low = low.cwiseMin(points_[k]);
    high = high.cwiseMax(points_[k]);
  }
  diagonal_ = (high - low).norm();
}

int Curve::segment_at(double s) const {
  const auto it = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, s);
  return static_cast<int>(it - arc_.begin()) - 1;
}

Vector2d Curve::at(double s) const {
  s = std::clamp(s, 0.0, length());
  const int k = segment_at(s);
  const double f = (s - arc_[k]) / (arc_[k + 1] - arc_[k]);
  return (1 - f) * points_[k] + f * points_[k + 1];
}

double Curve::heading(double s) const { return heading_[segment_at(s)]; }

}  // namespace kinetix::targets
