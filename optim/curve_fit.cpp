#include "optim/curve_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "targets/polyline_foot.hpp"

namespace kinetix {
namespace {

using Eigen::Vector2d;

Vector2d xz(const Eigen::Vector3d& v) { return {v.x(), v.z()}; }
Vector2d left_of(const Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace

std::vector<Vector2d> midline(const State& lattice, int rows) {
  std::vector<Vector2d> points;
  for (std::size_t b = 0; b < lattice.size(); b += rows + 1) points.push_back(xz(lattice[b].p));
  return points;
}

CurveFit::CurveFit(const Curve& goal, BendTies ties, double cell_mm, AngleRange theta)
    : goal_(goal), ties_(std::move(ties)), cell_mm_(cell_mm) {
  const double infinity = std::numeric_limits<double>::infinity();
  lower_ = Eigen::VectorXd::Constant(variables(), -infinity);
  upper_ = Eigen::VectorXd::Constant(variables(), infinity);
  for (int k = 0; k < ties_.variables(); ++k) {
    lower_[k] = ties_.range[k].lower;
    upper_[k] = ties_.range[k].upper;
  }
  lower_[ties_.variables()] = theta.lower;
  upper_[ties_.variables()] = theta.upper;
}

ExactDesign<double> CurveFit::design(const Eigen::VectorXd& x, int rows) const {
  auto design = ExactDesign<double>::basic(ties_.columns(), rows);
  for (int c = 0; c < ties_.columns(); ++c) design.beta[c] = ties_.sign[c] * x[ties_.variable[c]];
  design.theta = theta(x);
  return design;
}

Eigen::VectorXd CurveFit::pack(const std::vector<double>& bends, double theta) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(variables());
  Eigen::VectorXd members = Eigen::VectorXd::Zero(variables());
  for (int c = 0; c < ties_.columns(); ++c) {
    x[ties_.variable[c]] += bends[c];
    members[ties_.variable[c]] += 1;
  }
  for (int k = 0; k < ties_.variables(); ++k) x[k] /= members[k];
  x[ties_.variables()] = theta;
  x = x.cwiseMax(lower_).cwiseMin(upper_);

  State lattice;
  fold(design(x, 0), cell_mm_, lattice);
  const auto points = midline(lattice, 0);
  const Vector2d goal_chord = goal_.points().back() - goal_.points().front();
  const Vector2d chord = points.back() - points.front();
  const double heading = std::atan2(goal_chord.y(), goal_chord.x()) - std::atan2(chord.y(), chord.x());
  const Vector2d middle = (goal_.points().back() + goal_.points().front()) / 2;
  const Vector2d origin = middle - Eigen::Rotation2Dd(heading) * ((points.back() + points.front()) / 2);
  x.tail<3>() << heading, origin / goal_.diagonal();
  return x;
}

/// The folded midline in the goal's plane, with the rates of its points.
struct CurveFit::Frame {
  std::vector<Vector2d> points;
  std::vector<double> arc;
  Eigen::Matrix2d turn;
  Vector2d origin;
  State lattice;
  ExactJacobian jacobian;

  Frame(const CurveFit& fit, const Eigen::VectorXd& x, bool with_jacobian) {
    const auto design = fit.design(x, 0);
    if (with_jacobian)
      fold_with_jacobian(design, fit.cell_mm_, lattice, jacobian);
    else
      fold(design, fit.cell_mm_, lattice);
    turn = Eigen::Rotation2Dd(x[x.size() - 3]).toRotationMatrix();
    origin = fit.goal_.diagonal() * x.tail<2>();
    for (const Pose& pose : lattice) {
      points.push_back(turn * xz(pose.p) + origin);
      arc.push_back(points.size() == 1 ? 0.0
                                       : arc.back() + (points.back() - points[points.size() - 2]).norm());
    }
  }

  Vector2d place(int chord, double f) const { return (1 - f) * points[chord] + f * points[chord + 1]; }
  /// Fraction of the whole arc length.
  double fraction(int chord, double f) const {
    return ((1 - f) * arc[chord] + f * arc[chord + 1]) / arc.back();
  }
};

bool CurveFit::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const {
  if (!x.allFinite()) return false;
  const Frame frame(*this, x, J != nullptr);
  const double scale = goal_.diagonal(), weight = 1 / (scale * std::sqrt(static_cast<double>(residuals())));
  r.resize(residuals());
  if (J) J->setZero(residuals(), variables());

  const auto add_rates = [&](int row, int chord, double f, const Vector2d& place, const Vector2d& normal) {
    const Vector2d local = weight * (frame.turn.transpose() * normal);
    const auto rate = [&](int parameter, int body) {
      return local.dot(xz(frame.jacobian.twist(parameter, body).v));
    };
    const auto chord_rate = [&](int parameter) {
      return (1 - f) * rate(parameter, chord) + f * rate(parameter, chord + 1);
    };
    for (int c = 0; c <= std::min(chord, ties_.columns() - 1); ++c)
      (*J)(row, ties_.variable[c]) += ties_.sign[c] * chord_rate(frame.jacobian.beta(c));
    const int theta_at = ties_.variables();
    (*J)(row, theta_at) = chord_rate(frame.jacobian.theta());
    (*J)(row, theta_at + 1) = weight * normal.dot(left_of(place - frame.origin));
    (*J)(row, theta_at + 2) = weight * scale * normal.x();
    (*J)(row, theta_at + 3) = weight * scale * normal.y();
  };

  int row = 0;
  for (int chord = 0; chord < ties_.columns(); ++chord)
    for (int k = 0; k < places_per_cell; ++k, ++row) {
      const double f = (k + 0.5) / places_per_cell;
      const Vector2d place = frame.place(chord, f);
      const int guess = goal_.segment_at(frame.fraction(chord, f) * goal_.length());
      const Foot foot = foot_near(goal_.points(), guess, place);
      r[row] = weight * foot.distance;
      if (J) add_rates(row, chord, f, place, foot.normal);
    }
  for (const bool at_end : {false, true}) {
    const int chord = at_end ? ties_.columns() - 1 : 0;
    const Vector2d place = at_end ? frame.points.back() : frame.points.front();
    const Vector2d goal = at_end ? goal_.points().back() : goal_.points().front();
    for (const Vector2d& direction : {Vector2d(1, 0), Vector2d(0, 1)}) {
      r[row] = weight * direction.dot(place - goal);
      if (J) add_rates(row, chord, at_end ? 1.0 : 0.0, place, direction);
      ++row;
    }
  }
  return r.allFinite() && (!J || J->allFinite());
}

}  // namespace kinetix
