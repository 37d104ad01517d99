#include "optim/space_curve/space_fit.hpp"

#include <cmath>
#include <limits>

namespace kinetix::optim {
namespace {

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
