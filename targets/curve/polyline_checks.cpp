#include "targets/curve/polyline_checks.hpp"

#include <algorithm>
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

}  // namespace

InvalidCurve repeated_point(std::size_t k) {
  return InvalidCurve(
      "points " + number(k - 1) + " and " + number(k) + " are the same; every point must be new",
      static_cast<int>(k));
}

namespace {

/// 0 or 1: the axis along which the points spread more.
int longer_axis(const std::vector<Vector2d>& points) {
  Vector2d low = points[0], high = points[0];
  for (const Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
}

}  // namespace

void check_points(const std::vector<Vector2d>& points) {
  if (points.size() < 3)
    throw InvalidCurve("a curve needs at least 3 points, this one has " + std::to_string(points.size()), -1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite())
      throw InvalidCurve("point " + number(k) + " is not a finite number", static_cast<int>(k));
    if (k > 0 && (points[k] - points[k - 1]).norm() == 0) throw repeated_point(k);
  }
}

// Sweep along the longer axis: segments are compared only where their ranges overlap.
void check_crossing(const std::vector<Vector2d>& points) {
  const int segments = static_cast<int>(points.size()) - 1;
  const bool closed = points.front() == points.back();
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
      const bool around = closed && first == 0 && second == segments - 1;
      if (second == first + 1 || around) {
        const int joint = around ? 0 : second;
        const Vector2d u = points[first + 1] - points[first], v = points[second + 1] - points[second];
        if (cross(u, v) == 0 && u.dot(v) < 0)
          throw InvalidCurve("the curve turns back on itself at point " + number(joint), joint);
      } else if (touch(points[a], points[a + 1], points[k], points[k + 1])) {
        throw InvalidCurve("the curve crosses itself: segment " + number(first) + "-" + number(first + 1) +
                               " meets segment " + number(second) + "-" +
                               number(closed && second == segments - 1 ? 0 : second + 1),
                           std::min(second, segments - (closed ? 1 : 0)));
      }
    }
    active.push_back(k);
  }
}

}  // namespace kinetix::targets
