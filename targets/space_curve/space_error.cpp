#include "targets/space_curve/space_error.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "model/base/rotation_vector.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int midline_samples_per_cell = 20;  // as formats.md says of shape_rms
constexpr int most_rounds = 50;               // each is a Newton step; a few do where the goal is near
constexpr double still_rms = 1e-9;            // of the diagonal: steps below leave the rms as it is
constexpr double regular = 1e-9;  // of the normal matrix' trace: a straight goal may turn about itself

/// Distance of p from the curve, and the way in which the nearest place goes with p: unit, or nothing at an end.
struct Nearest {
  Vector3d off, along;
};

Nearest nearest_to(const SpaceCurve& curve, const Vector3d& p) {
  const double s = curve.nearest(p);
  const double reach = 1e-6 * curve.length();
  const bool is_end = s < curve.first() + reach || s > curve.last() - reach;
  return {p - curve.at(s), is_end ? Vector3d(Vector3d::Zero()) : curve.direction(s, reach)};
}

Vector3d carried(const model::Pose& pose, const Vector3d& p) { return pose.R * p + pose.p; }

/// The two polylines, and the pose of the goal.
class Alignment {
 public:
  Alignment(const SpaceCurve& midline, const SpaceGoal& goal, int cells, const model::Pose& place)
      : midline_(midline),
        goal_(goal),
        on_midline_(midline.evenly(midline_samples_per_cell * cells + 1)),
        on_goal_(goal.line().evenly(midline_samples_per_cell * cells + 1)),
        pose_(place) {}

  /// Moves the goal by a Gauss-Newton step on the distances, whose nearest places slide along the curves up to their ends.
  /// @return how far that took it, mm
  double step() {
    normal_.setZero();
    right_.setZero();
    const model::Pose back{pose_.R.transpose(), -(pose_.R.transpose() * pose_.p)};
    for (const Vector3d& p : on_midline_) {
      const Nearest at = nearest_to(goal_.line(), carried(back, p));
      add(p, pose_.R * at.off, pose_.R * at.along);
    }
    for (const Vector3d& q : on_goal_) {
      const Nearest at = nearest_to(midline_, carried(pose_, q));
      add(carried(pose_, q), -at.off, at.along);
    }
    normal_.diagonal().array() += regular * normal_.trace();
    const Vector6 x = normal_.ldlt().solve(right_);
    const Vector3d turn = x.head<3>(), shift = x.tail<3>();
    const Eigen::Matrix3d R = rotation_of(turn);
    pose_ = {R * pose_.R, R * pose_.p + shift};
    return (turn.cross(pose_.p) + shift).norm() + turn.norm() * goal_.diagonal();
  }

  SpaceError error() const {
    SpaceError out;
    out.scale_mm = goal_.diagonal();
    double sum = 0;
    const model::Pose back{pose_.R.transpose(), -(pose_.R.transpose() * pose_.p)};
    const auto count = [&](double distance) {
      sum += distance * distance;
      out.max = std::max(out.max, distance / out.scale_mm);
    };
    for (const Vector3d& p : on_midline_) count(nearest_to(goal_.line(), carried(back, p)).off.norm());
    for (std::size_t k = 0; k < on_goal_.size(); ++k) {
      const double distance = nearest_to(midline_, carried(pose_, on_goal_[k])).off.norm();
      count(distance);
      out.distance_mm.push_back(distance);
      out.arc_mm.push_back(goal_.length() * static_cast<double>(k) /
                           static_cast<double>(on_goal_.size() - 1));
    }
    out.rms = std::sqrt(sum / static_cast<double>(on_midline_.size() + on_goal_.size())) / out.scale_mm;
    for (const Vector3d& q : goal_.points()) out.goal_mm.push_back(carried(pose_, q));
    return out;
  }

 private:
  /// A place and how far it is from where the goal should have it.
  void add(const Vector3d& place, const Vector3d& miss, const Vector3d& along) {
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
    Eigen::Matrix<double, 3, 6> derivatives;
    derivatives.col(0) = Vector3d::UnitX().cross(place);
    derivatives.col(1) = Vector3d::UnitY().cross(place);
    derivatives.col(2) = Vector3d::UnitZ().cross(place);
    derivatives.rightCols<3>().setIdentity();
    normal_ += derivatives.transpose() * across * derivatives;
    right_ += derivatives.transpose() * miss;
  }

  const SpaceCurve& midline_;
  const SpaceGoal& goal_;
  std::vector<Vector3d> on_midline_, on_goal_;
  model::Pose pose_;
  Matrix6 normal_;
  Vector6 right_;
};

SpaceError not_finite(const SpaceGoal& goal) {
  SpaceError out;
  out.rms = out.max = std::numeric_limits<double>::quiet_NaN();
  out.scale_mm = goal.diagonal();
  out.settled = false;
  return out;
}

}  // namespace

SpaceError space_error(const std::vector<Vector3d>& midline, const SpaceGoal& goal,
                       const model::Pose& place) {
  for (const Vector3d& p : midline)
    if (!p.allFinite()) return not_finite(goal);
  if (!place.p.allFinite() || !place.R.allFinite()) return not_finite(goal);
  const SpaceCurve line(midline);
  Alignment alignment(line, goal, static_cast<int>(midline.size()) - 1, place);
  bool settled = false;
  for (int k = 0; k < most_rounds && !settled; ++k) settled = alignment.step() < still_rms * goal.diagonal();
  SpaceError out = alignment.error();
  out.settled = settled;
  return out;
}

}  // namespace kinetix::targets
