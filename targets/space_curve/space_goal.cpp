#include "targets/space_curve/space_goal.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "model/base/box.hpp"
#include "targets/curve/polyline.hpp"

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

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int midline_samples_per_cell = 20;  // as formats.md says of shape_rms
constexpr int max_rounds = 50;                // each is a Newton step; a few do where the goal is near
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
  for (int k = 0; k < max_rounds && !settled; ++k) settled = alignment.step() < still_rms * goal.diagonal();
  SpaceError out = alignment.error();
  out.settled = settled;
  return out;
}

const KeyTable& space_curve_target_keys() {
  static const KeyTable keys({
      goal_kind_key("space_curve"),
      {"points", space_points_type(max_space_points), needed,
       "the goal, in mm: open, not meeting itself. A table has one point per row, and may start with the "
       "header "
       "`x,y,z`"},
      point_keys()[0],
      point_keys()[1],
  });
  return keys;
}

SpaceGoal read_space_goal(const Section& target, bool checks_size, std::vector<std::string>& notes) {
  SpacePoints read = read_space_points(target, "points", {{{"x", "y", "z"}, max_space_points}, checks_size});
  notes.insert(notes.end(), read.notes.begin(), read.notes.end());
  return make_from_points(std::move(read),
                          [](std::vector<Eigen::Vector3d> p) { return SpaceGoal(std::move(p)); });
}

}  // namespace kinetix::targets
