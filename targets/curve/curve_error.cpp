#include "targets/curve/curve_error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "targets/curve/polyline_tree.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

// Points of each polyline per cell of the midline. Distances are to the other polyline, not to its samples,
// so that more would only refine the mean; far fewer could step over a narrow bump of the goal.
constexpr int samples_per_cell = 20;
// Levenberg-Marquardt steps before the alignment gives up: an end to the loop, where rounding stalls it.
constexpr int max_alignment_steps = 200;

/// Rigid motion of the goal onto the midline's plane.
struct Motion {
  double turn = 0;
  Vector2d shift = Vector2d::Zero();

  Vector2d operator()(const Vector2d& p) const { return Eigen::Rotation2Dd(turn) * p + shift; }
  Vector2d inverse(const Vector2d& p) const { return Eigen::Rotation2Dd(-turn) * (p - shift); }
};

/// count >= 2 points evenly spaced by arc length, ends included.
Points resampled(const Points& polyline, int count) {
  std::vector<double> arc{0};
  for (std::size_t k = 1; k < polyline.size(); ++k)
    arc.push_back(arc.back() + (polyline[k] - polyline[k - 1]).norm());
  Points out;
  std::size_t k = 1;
  for (int n = 0; n < count; ++n) {
    const double s = arc.back() * n / (count - 1);
    while (k + 1 < arc.size() && arc[k] < s) ++k;
    const double step = arc[k] - arc[k - 1];
    const double f = step > 0 ? std::min((s - arc[k - 1]) / step, 1.0) : 0.0;
    out.push_back((1 - f) * polyline[k - 1] + f * polyline[k]);
  }
  return out;
}

/// Least squares in closed form. @param from, to as many points each
Motion match_samples(const Points& from, const Points& to) {
  Vector2d middle = Vector2d::Zero(), goal = Vector2d::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) {
    middle += from[k] / static_cast<double>(from.size());
    goal += to[k] / static_cast<double>(from.size());
  }
  double along = 0, across = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Vector2d a = from[k] - middle, b = to[k] - goal;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Motion turned{std::atan2(across, along)};
  return {turned.turn, goal - turned(middle)};
}

/// Residuals in both directions, and their normal equations in (turn, shift) about a motion.
struct TwoSided {
  double squared = 0, largest = 0;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();

  /// @param q the place on the moving goal, relative to its centre; @param normal rate of the residual with q
  void add(double residual, const Vector2d& normal, const Vector2d& q) {
    const Eigen::Vector3d row(normal.y() * q.x() - normal.x() * q.y(), normal.x(), normal.y());
    H += row * row.transpose();
    g += residual * row;
    squared += residual * residual;
    largest = std::max(largest, std::abs(residual));
  }
};

class Alignment {
 public:
  Alignment(const Points& midline, const Curve& goal, int samples)
      : midline_(midline),
        goal_(goal.points()),
        midline_samples_(resampled(midline, samples)),
        goal_samples_(resampled(goal.points(), samples)) {}

  TwoSided measure(const Motion& motion) const {
    TwoSided sum;
    for (const Vector2d& g : goal_samples_) {
      const Vector2d placed = motion(g);
      const ClosestPoint closest = midline_.nearest(placed);
      sum.add(closest.distance, closest.normal, placed - motion.shift);
    }
    for (const Vector2d& m : midline_samples_) {
      const ClosestPoint closest = goal_.nearest(motion.inverse(m));
      const Vector2d normal = Eigen::Rotation2Dd(motion.turn) * closest.normal;
      sum.add(-closest.distance, normal, motion(closest.point) - motion.shift);
    }
    return sum;
  }

  double mean_squared(const TwoSided& sum) const {
    return sum.squared / static_cast<double>(goal_samples_.size() + midline_samples_.size());
  }

  Motion first_guess() const { return match_samples(goal_samples_, midline_samples_); }
  ClosestPoint closest_to_goal_sample(std::size_t k, const Motion& motion) const {
    return midline_.nearest(motion(goal_samples_[k]));
  }
  std::size_t samples() const { return goal_samples_.size(); }

 private:
  PolylineTree midline_, goal_;
  Points midline_samples_, goal_samples_;
};

struct Aligned {
  Motion motion;
  TwoSided sum;
  bool settled = false;
};

/// Aligns the goal by Levenberg-Marquardt on the three numbers of the motion.
Aligned align(const Alignment& alignment, double scale) {
  Aligned best{alignment.first_guess(), {}, false};
  best.sum = alignment.measure(best.motion);
  double damping = 1e-9;
  for (int step = 0; step < max_alignment_steps && !best.settled; ++step) {
    Eigen::Matrix3d H = best.sum.H;
    H.diagonal() *= 1 + damping;
    const Eigen::Vector3d move = -H.ldlt().solve(best.sum.g);
    const Motion next{best.motion.turn + move[0], best.motion.shift + move.tail<2>()};
    const TwoSided sum = alignment.measure(next);
    const double size = std::abs(move[0]) * scale + move.tail<2>().norm();
    if (!(size > 1e-13 * scale) || damping > 1e12) best.settled = true;
    if (sum.squared < best.sum.squared) {
      best.settled = best.settled || best.sum.squared - sum.squared <= 1e-12 * best.sum.squared;
      best.motion = next;
      best.sum = sum;
      damping = std::max(damping / 10, 1e-12);
    } else {
      damping = std::max(damping * 10, 1e-6);
    }
  }
  return best;
}

}  // namespace

CurveError curve_error(const Points& midline, const Curve& goal) {
  CurveError error;
  error.scale_mm = goal.diagonal();
  if (!std::all_of(midline.begin(), midline.end(), [](const Vector2d& p) { return p.allFinite(); })) {
    error.rms = error.max = std::numeric_limits<double>::quiet_NaN();
    error.settled = false;
    return error;
  }
  const int samples = samples_per_cell * static_cast<int>(midline.size() - 1) + 1;
  const Alignment alignment(midline, goal, samples);
  const Aligned best = align(alignment, error.scale_mm);
  error.settled = best.settled;
  error.rms = std::sqrt(alignment.mean_squared(best.sum)) / error.scale_mm;
  error.max = best.sum.largest / error.scale_mm;
  for (const Vector2d& p : goal.points()) error.goal_mm.push_back(best.motion(p));
  for (std::size_t k = 0; k < alignment.samples(); ++k) {
    error.arc_mm.push_back(goal.length() * static_cast<double>(k) / static_cast<double>(samples - 1));
    error.distance_mm.push_back(alignment.closest_to_goal_sample(k, best.motion).distance);
  }
  return error;
}

}  // namespace kinetix::targets
