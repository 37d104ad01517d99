#include "targets/outline/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "targets/curve/polyline_checks.hpp"
#include "targets/curve/polyline_closest_point.hpp"
#include "targets/outline/orientation.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

double cross_product(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Outline::Outline(std::vector<Vector2d> points) : points_(std::move(points)) {
  if (points_.size() > 1 && points_.front() == points_.back()) points_.pop_back();
  check_points(points_);
  std::vector<Vector2d> loop = points_;
  loop.push_back(points_.front());
  check_crossing(loop);
  double twice = 0;
  for (std::size_t k = 0; k + 1 < loop.size(); ++k)
    twice += cross_product(loop[k] - loop[0], loop[k + 1] - loop[0]);
  if (twice < 0) {
    std::reverse(points_.begin(), points_.end());
    loop = points_;
    loop.push_back(points_.front());
  }
  area_ = std::abs(twice) / 2;
  arc_.push_back(0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector2d &a = loop[k], &b = loop[k + 1];
    arc_.push_back(arc_.back() + (b - a).norm());
    middle_ += cross_product(a - loop[0], b - loop[0]) * ((a - loop[0]) + (b - loop[0]));
  }
  middle_ = loop[0] + middle_ / (6 * area_);
  diagonal_ = smallest_diagonal(*this);
}

Vector2d Outline::at(double s) const {
  s -= perimeter() * std::floor(s / perimeter());
  const auto it = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, s);
  const auto k = static_cast<std::size_t>(it - arc_.begin()) - 1;
  const Vector2d &a = points_[k], &b = points_[(k + 1) % points_.size()];
  return a + (s - arc_[k]) / (arc_[k + 1] - arc_[k]) * (b - a);
}

Outline::Nearest Outline::nearest(const Vector2d& p) const {
  double best = std::numeric_limits<double>::infinity(), part = 0;
  std::size_t side = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector2d &a = points_[k], along = points_[(k + 1) % points_.size()] - a;
    const double at = fraction_along(a, along, p);
    const double square = (p - a - at * along).squaredNorm();
    if (!(square < best)) continue;
    best = square;
    part = at;
    side = k;
  }
  const Vector2d &a = points_[side], along = points_[(side + 1) % points_.size()] - a;
  Nearest out;
  out.point = a + part * along;
  out.arc = arc_[side] + part * (arc_[side + 1] - arc_[side]);
  out.distance = std::sqrt(best);
  out.normal = Vector2d(along.y(), -along.x()).normalized();
  const bool is_corner = (part == 0 || part == 1) && out.distance > 0;
  if (is_corner) out.normal = (contains(p) ? -1 : 1) * (p - out.point) / out.distance;
  return out;
}

bool Outline::contains(const Vector2d& p) const {
  bool inside = false;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector2d &a = points_[k], &b = points_[(k + 1) % points_.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

std::vector<Vector2d> Outline::corners(double turn) const {
  std::vector<Vector2d> out;
  const std::size_t count = points_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2d in = points_[k] - points_[(k + count - 1) % count],
                   on = points_[(k + 1) % count] - points_[k];
    if (std::abs(std::atan2(cross_product(in, on), in.dot(on))) > turn) out.push_back(points_[k]);
  }
  return out;
}

}  // namespace kinetix::targets
