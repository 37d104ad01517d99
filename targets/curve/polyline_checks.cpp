#include "targets/curve/polyline_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "model/base/box_of.hpp"
#include "targets/curve/segment_pairs.hpp"

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

template <class Point>
void check_points(const std::vector<Point>& points) {
  if (points.size() < 3)
    throw InvalidCurve("a curve needs at least 3 points, this one has " + std::to_string(points.size()), -1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite())
      throw InvalidCurve("point " + number(k) + " is not a finite number", static_cast<int>(k));
    if (k > 0 && !((points[k] - points[k - 1]).norm() > 0)) throw repeated_point(k);
  }
}

template void check_points(const std::vector<Eigen::Vector2d>& points);
template void check_points(const std::vector<Eigen::Vector3d>& points);

template <class Point>
void check_open(const std::vector<Point>& points) {
  if ((points.front() - points.back()).norm() <= touching * model::box_of(points).diagonal().norm())
    throw InvalidCurve("the curve is closed (its last point is its first); a strip needs an open curve",
                       static_cast<int>(points.size()) - 1);
}

template void check_open(const std::vector<Eigen::Vector2d>& points);
template void check_open(const std::vector<Eigen::Vector3d>& points);

InvalidCurve turns_back(std::size_t k) {
  return InvalidCurve("the curve turns back on itself at point " + number(k), static_cast<int>(k));
}

InvalidCurve crosses_itself(std::size_t first, std::size_t second, bool closes) {
  return InvalidCurve("the curve crosses itself: segment " + number(first) + "-" + number(first + 1) +
                          " meets segment " + number(second) + "-" + number(closes ? 0 : second + 1),
                      static_cast<int>(second));
}

void check_crossing(const std::vector<Vector2d>& points) {
  const int last = static_cast<int>(points.size()) - 2;
  const bool closed = points.front() == points.back();
  for_segment_pairs(points, 0, [&](int first, int second) {
    const bool around = closed && first == 0 && second == last;
    if (second == first + 1 || around) {
      const Vector2d u = points[first + 1] - points[first], v = points[second + 1] - points[second];
      if (cross(u, v) == 0 && u.dot(v) < 0) throw turns_back(around ? 0 : second);
    } else if (touch(points[first], points[first + 1], points[second], points[second + 1])) {
      throw crosses_itself(first, second, closed && second == last);
    }
  });
}

}  // namespace kinetix::targets
