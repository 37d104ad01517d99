#include "targets/curve/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/base/box_of.hpp"
#include "targets/curve/polyline_checks.hpp"

namespace kinetix::targets {

using Eigen::Vector2d;

Curve::Curve(std::vector<Vector2d> points) : points_(std::move(points)) {
  check_points(points_);
  check_open(points_);
  check_crossing(points_);
  diagonal_ = model::box_of(points_).diagonal().norm();
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
