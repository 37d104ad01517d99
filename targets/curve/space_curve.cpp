#include "targets/curve/space_curve.hpp"

#include <algorithm>
#include <limits>

namespace kinetix::targets {

using Eigen::Vector3d;

SpaceCurve::SpaceCurve(const std::vector<Vector3d>& points, double first)
    : points_{points.front()}, arc_{first} {
  for (const Vector3d& p : points) {
    const double next = arc_.back() + (p - points_.back()).norm();
    if (!(next > arc_.back())) continue;
    points_.push_back(p);
    arc_.push_back(next);
  }
}

std::size_t SpaceCurve::segment_at(double s) const {
  const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, s);
  return static_cast<std::size_t>(above - arc_.begin()) - 1;
}

Vector3d SpaceCurve::at(double s) const {
  const std::size_t k = segment_at(s);
  const double f = std::clamp((s - arc_[k]) / (arc_[k + 1] - arc_[k]), 0.0, 1.0);
  return (1 - f) * points_[k] + f * points_[k + 1];
}

Vector3d SpaceCurve::direction(double s, double reach) const {
  return (at(s + reach) - at(s - reach)).normalized();
}

double SpaceCurve::nearest(const Vector3d& p) const {
  double best = first(), least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
    const Vector3d along = points_[k + 1] - points_[k];
    const double f = std::clamp((p - points_[k]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double squared = (points_[k] + f * along - p).squaredNorm();
    if (!(squared < least)) continue;
    least = squared;
    best = arc_[k] + f * (arc_[k + 1] - arc_[k]);
  }
  return best;
}

SpaceCurve SpaceCurve::part(double from, double to) const {
  std::vector<Vector3d> points = {at(from)};
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (arc_[k] > from && arc_[k] < to) points.push_back(points_[k]);
  points.push_back(at(to));
  return SpaceCurve(points, from);
}

std::vector<Vector3d> SpaceCurve::evenly(int count) const {
  std::vector<Vector3d> points;
  for (int k = 0; k < count; ++k) points.push_back(at(first() + length() * k / (count - 1)));
  return points;
}

}  // namespace kinetix::targets
