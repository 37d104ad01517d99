#include "optim/space_curve/space_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/base/decompositions.hpp"
#include "optim/space_curve/fit_space_curve.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr int directions = 2000;     // on half a sphere: about 3 degrees apart
constexpr double first_step = 0.03;  // rad: about half their spacing
constexpr double last_step = 1e-7;   // rad: below the accuracy of slopes
constexpr double slow = 1e-3;        // of a step: one that lowers the slope by less moves along a ridge
constexpr int max_stretches = 400;   // of a goal; slopes vary little from one to the next

struct Stretches {
  std::vector<Vector3d> along;  ///< unit
  std::vector<double> arc_mm;
};

Stretches stretches_of(const targets::SpaceCurve& line, double stretch) {
  Stretches out;
  for (int k = 0; k < max_stretches; ++k) {
    const double s = line.length() * (k + 0.5) / max_stretches;
    out.along.push_back(line.direction(s, stretch / 2));
    out.arc_mm.push_back(s);
  }
  return out;
}

/// Returns the largest component of a stretch along y, the sine of its slope, and sets the index of that
/// stretch.
double steepest(const Stretches& all, const Vector3d& y, std::size_t& where) {
  double most = -1;
  for (std::size_t k = 0; k < all.along.size(); ++k)
    if (const double part = std::abs(all.along[k].dot(y)); part > most) {
      most = part;
      where = k;
    }
  return most;
}

/// Returns whether the largest component is below `least`, and then lowers `least` to it.
bool lowers(const Stretches& all, const Vector3d& y, double& least) {
  double most = -1;
  for (const Vector3d& along : all.along) {
    most = std::max(most, std::abs(along.dot(y)));
    if (!(most < least)) return false;
  }
  least = most;
  return true;
}

/// Returns point k, evenly spread over half a sphere (Fibonacci's spiral).
Vector3d spread(int k) {
  const double z = (k + 0.5) / directions, turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

Vector3d first_direction(const Stretches& all) {
  Vector3d best = Vector3d::UnitY();
  double least = std::numeric_limits<double>::infinity();
  lowers(all, best, least);
  for (int k = 0; k < directions; ++k)
    if (const Vector3d y = spread(k); lowers(all, y, least)) best = y;
  return best;
}

/// Refines a direction by steps to eight sides, halved when none is much better.
Vector3d refined(const Stretches& all, Vector3d y) {
  double least = std::numeric_limits<double>::infinity();
  lowers(all, y, least);
  for (double step = first_step; step > last_step;) {
    const Vector3d u = y.unitOrthogonal(), v = y.cross(u);
    const double before = least;
    Vector3d better = y;
    for (int k = 0; k < 8; ++k) {
      const double turn = k * std::numbers::pi / 4;
      const Vector3d next = (y + step * (std::cos(turn) * u + std::sin(turn) * v)).normalized();
      if (lowers(all, next, least)) better = next;
    }
    if (!(before - least > slow * step)) step /= 2;
    y = better;
  }
  return y;
}

/// Returns a direction with its largest slope.
Across across_along(const Stretches& all, const Vector3d& direction) {
  Across out;
  out.direction = direction;
  std::size_t where = 0;
  const double part = steepest(all, direction, where);
  out.slope = part < 1 ? part / std::sqrt(1 - part * part) : std::numeric_limits<double>::infinity();
  out.arc_mm = all.arc_mm[where];
  return out;
}

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

Vector3d along(double heading) { return {std::cos(heading), 0, std::sin(heading)}; }
/// Derivative of along() by the heading.
Vector3d beside(double heading) { return {-std::sin(heading), 0, std::cos(heading)}; }
Vector3d quarter(const Vector3d& v) { return {-v.z(), 0, v.x()}; }

/// Nearest place of the goal, and the projection of a place's motion that changes the distance. It is across
/// the segment, or all of the motion if a corner is nearest.
struct Nearest {
  Vector3d point;
  Eigen::Matrix3d left;
};

Nearest on_segment(const targets::SpaceCurve& goal, std::size_t k, const Vector3d& p) {
  const Vector3d a = goal.points()[k], v = goal.points()[k + 1] - a;
  const double f = (p - a).dot(v) / v.squaredNorm();
  if (!(f > 0)) return {a, Eigen::Matrix3d::Identity()};
  if (!(f < 1)) return {a + v, Eigen::Matrix3d::Identity()};
  return {a + f * v, Eigen::Matrix3d::Identity() - v * v.transpose() / v.squaredNorm()};
}

/// Returns the nearest place, searched downhill from arc length s.
Nearest nearest_from(const targets::SpaceCurve& goal, double s, const Vector3d& p) {
  const auto& arcs = goal.arcs();
  const std::size_t segments = arcs.size() - 1;
  std::size_t k = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, s) - arcs.begin() - 1;
  Nearest best = on_segment(goal, k, p);
  double least = (best.point - p).squaredNorm();
  for (const int direction : {1, -1})
    for (std::size_t next = k; direction > 0 ? next + 1 < segments : next > 0;) {
      next += direction;
      const Nearest at = on_segment(goal, next, p);
      const double squared = (at.point - p).squaredNorm();
      if (squared > least) break;
      best = at;
      least = squared;
    }
  return best;
}

/// Midline with the derivatives of its points by the unknowns of SpaceFit.
class Chain {
 public:
  explicit Chain(const SpaceStrip& strip) : strip_(strip) {
    points_.push_back(strip.start);
    arc_.push_back(0);
    double heading = strip.heading;
    for (int k = 0; k < strip.columns; ++k) {
      Vector3d step = along(heading);
      if (SpaceStrip::bends(k)) {
        heading += strip.turn[k / 2];
        step = (step + along(heading)) / 2;
      } else {
        step.y() = strip.climb[k / 2];
      }
      after_.push_back(heading);
      points_.push_back(points_.back() + strip.step * step);
      arc_.push_back(arc_.back() + strip.step * step.norm());
    }
  }

  const std::vector<Vector3d>& points() const { return points_; }
  double arc(int column, double f) const { return (1 - f) * arc_[column] + f * arc_[column + 1]; }
  double length() const { return arc_.back(); }
  Vector3d place(int column, double f) const { return (1 - f) * points_[column] + f * points_[column + 1]; }

  /// Computes d place by all unknowns except the scales of start and step.
  void derivatives(int column, double f, Matrix3Xd& out) const {
    out.setZero();
    const Vector3d p = place(column, f);
    for (int k = 0; k <= column; ++k) {
      const double done = k < column ? 1 : f;
      if (SpaceStrip::bends(k))
        out.col(k / 2) = done * strip_.step / 2 * beside(after_[k]) +
                         (k < column ? quarter(p - points_[k + 1]) : Vector3d::Zero());
      else
        out(1, strip_.bending() + k / 2) = done * strip_.step;
    }
    out.col(strip_.columns) = quarter(p - strip_.start);
    out.middleCols<3>(strip_.columns + 1).setIdentity();
    out.col(strip_.columns + 4) = (p - strip_.start) / strip_.step;
  }

 private:
  const SpaceStrip& strip_;
  std::vector<Vector3d> points_;
  std::vector<double> arc_, after_;  ///< arc length of each point; heading after each column
};

}  // namespace

Across mean_slope(const targets::SpaceGoal& goal, double stretch) {
  const Stretches all = stretches_of(goal.line(), stretch);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Vector3d& along : all.along) sum += along * along.transpose();
  return across_along(all, principal_axes(sum).axes.col(0));
}

Across min_slope(const targets::SpaceGoal& goal, double stretch) {
  const Stretches all = stretches_of(goal.line(), stretch);
  return across_along(all, refined(all, first_direction(all)));
}

Eigen::Matrix3d frame_across(const targets::SpaceGoal& goal, const Vector3d& y) {
  const Vector3d chord = goal.points()[1] - goal.points()[0];
  const Vector3d seen = chord - chord.dot(y) * y;
  const Vector3d x = seen.norm() > 1e-9 * chord.norm() ? seen.normalized() : y.unitOrthogonal();
  Eigen::Matrix3d frame;
  frame << x, y, x.cross(y);
  return frame;
}

std::vector<Vector3d> SpaceStrip::midline() const { return Chain(*this).points(); }

SpaceFit::SpaceFit(const targets::SpaceCurve& goal, double scale, const SpaceStrip& first,
                   const SpaceLimits& limits)
    : goal_(goal), scale_(scale), columns_(first.columns), first_step_(first.step) {
  upper_ = Eigen::VectorXd::Constant(variables(), std::numeric_limits<double>::infinity());
  upper_.head(first.bending()).setConstant(limits.turn);
  upper_.segment(first.bending(), first.shearing()).setConstant(limits.climb);
  lower_ = -upper_;
  lower_[columns_ + 4] = limits.min_step / first_step_;
  upper_[columns_ + 4] = limits.max_step / first_step_;
}

SpaceStrip SpaceFit::strip(const Eigen::VectorXd& x) const {
  SpaceStrip out;
  out.columns = columns_;
  out.turn.assign(x.data(), x.data() + out.bending());
  out.climb.assign(x.data() + out.bending(), x.data() + columns_);
  out.heading = x[columns_];
  out.start = scale_ * x.segment<3>(columns_ + 1);
  out.step = first_step_ * x[columns_ + 4];
  return out;
}

Eigen::VectorXd SpaceFit::pack(const SpaceStrip& strip) const {
  Eigen::VectorXd x(variables());
  for (int k = 0; k < strip.bending(); ++k) x[k] = strip.turn[k];
  for (int k = 0; k < strip.shearing(); ++k) x[strip.bending() + k] = strip.climb[k];
  x[columns_] = strip.heading;
  x.segment<3>(columns_ + 1) = strip.start / scale_;
  x[columns_ + 4] = strip.step / first_step_;
  return x.cwiseMax(lower_).cwiseMin(upper_);
}

bool SpaceFit::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const {
  if (!x.allFinite()) return false;
  const SpaceStrip strip = this->strip(x);
  const Chain chain(strip);
  const double weight = 1 / (scale_ * std::sqrt(residuals() / 3.0));
  r.resize(residuals());
  if (J) J->resize(residuals(), variables());
  Matrix3Xd derivatives(3, variables());
  int row = 0;
  const auto add = [&](int column, double f, const Nearest& at) {
    r.segment<3>(row) = weight * (chain.place(column, f) - at.point);
    if (J) {
      chain.derivatives(column, f, derivatives);
      derivatives.middleCols<3>(columns_ + 1) *= scale_;
      derivatives.col(columns_ + 4) *= first_step_;
      J->middleRows<3>(row) = weight * at.left * derivatives;
    }
    row += 3;
  };
  const auto fixed = [](const Vector3d& p) { return Nearest{p, Eigen::Matrix3d::Identity()}; };
  for (int column = 0; column < columns_; ++column)
    for (int k = 0; k < places_per_column; ++k) {
      const double f = (k + 0.5) / places_per_column;
      const double s = chain.arc(column, f) / chain.length() * goal_.length();
      add(column, f, nearest_from(goal_, s, chain.place(column, f)));
    }
  add(0, 0, fixed(goal_.points().front()));
  add(columns_ - 1, 1, fixed(goal_.points().back()));
  return r.allFinite() && (!J || J->allFinite());
}

SpaceStrip followed(const targets::SpaceCurve& goal, int columns) {
  SpaceStrip out;
  out.columns = columns;
  const auto at = [&](double column) {
    return goal.at(goal.length() * std::clamp(column / columns, 0.0, 1.0));
  };
  // Panel m is column 2 m and half of each adjacent bending column.
  double before = 0, seen = 0;
  std::vector<double> headings, rises;
  for (int m = 0; m < out.shearing(); ++m) {
    const double from = 2 * m - 0.5, to = 2 * m + 1.5;
    const Vector3d chord = at(to) - at(from);
    const double heading = std::atan2(chord.z(), chord.x());
    before = m == 0 ? heading : before + std::remainder(heading - before, 2 * std::numbers::pi);
    headings.push_back(before);
    rises.push_back(chord.y());
    seen += std::hypot(chord.x(), chord.z());
  }
  for (int k = 0; k < out.bending(); ++k)
    out.turn.push_back(k + 1 < out.shearing() ? headings[k + 1] - headings[k] : 0);
  out.step = seen / columns;
  for (const double rise : rises) out.climb.push_back(rise / out.step);
  out.heading = headings.front();
  out.start = goal.points().front();
  return out;
}

}  // namespace kinetix::optim
