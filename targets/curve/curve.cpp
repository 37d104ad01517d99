#include "targets/curve/curve.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "targets/curve/polyline_checks.hpp"

namespace kinetix::targets {

namespace {

using Eigen::Vector2d;

constexpr double ends_meet = 1e-9;  // of the diagonal: closer ones are apart by rounding

double diagonal_around(const std::vector<Vector2d>& points) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& point : points) box.extend(point);
  return box.diagonal().norm();
}

}  // namespace

Curve::Curve(std::vector<Vector2d> points) : points_(std::move(points)) {
  check_points(points_);
  diagonal_ = diagonal_around(points_);
  if ((points_.front() - points_.back()).norm() <= ends_meet * diagonal_)
    throw InvalidCurve("the curve is closed (its last point is its first); a strip needs an open curve",
                       static_cast<int>(points_.size()) - 1);
  check_crossing(points_);
  arc_.push_back(0);
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const Vector2d step = points_[k] - points_[k - 1];
    arc_.push_back(arc_.back() + step.norm());
    if (!(arc_[k] > arc_[k - 1])) throw repeated_point(k);
    const double heading = std::atan2(step.y(), step.x());
    const double before = k == 1 ? heading : heading_.back();
    heading_.push_back(before + std::remainder(heading - before, 2 * std::numbers::pi));
  }
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
