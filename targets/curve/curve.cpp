#include "targets/curve/curve.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/base/box.hpp"
#include "targets/curve/polyline.hpp"

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
  return InvalidCurve("points " + number(k - 1) + " and " + number(k) + " are the same. Remove one of them",
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
    throw InvalidCurve("the curve is closed: its last point is its first. Give an open curve",
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

namespace {

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
