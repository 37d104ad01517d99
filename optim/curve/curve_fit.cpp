#include "optim/curve/curve_fit.hpp"

#include <limits>
#include <map>
#include <utility>

#include "targets/curve/polyline.hpp"

namespace kinetix::optim {
namespace {

int group(int column, int columns, Per per, Symmetry symmetry) {
  if (per == Per::all) return 0;
  const bool mirrored = symmetry == Symmetry::mirror_x || symmetry == Symmetry::rotate_2;
  return mirrored ? std::min(column, columns - 1 - column) : column;
}

/// Returns the range of a column's tilt in its first row. Tilts change sign from row to row.
AngleRange range_of_size(const model::Structure& strip, const BendTies& ties, int column) {
  const int first = strip.hinge_at({{column, 0}, model::Axis::x}).value();
  const AngleRange& bends = ties.range[ties.variable[column]];
  return ties.sign[column] * strip.hinges[first].parameters.beta > 0 ? bends
                                                                     : AngleRange{-bends.upper, -bends.lower};
}

}  // namespace

BendTies make_bend_ties(int columns, Per per, Symmetry symmetry, AngleRange beta) {
  if (per != Per::column && per != Per::all)
    throw InvalidInput(
        "a strip has one degree of freedom only if all tilts of a column are equal. Give column or all");
  if (symmetry == Symmetry::rotate_4)
    throw InvalidInput(
        "a sheet that bends along x cannot have a four-fold symmetry. Give none, mirror_x, mirror_y or "
        "rotate_2");
  BendTies ties;
  for (int c = 0; c < columns; ++c) {
    ties.variable.push_back(group(c, columns, per, symmetry));
    // A turn from +x towards +z needs a negative tilt in the even columns.
    ties.sign.push_back(-model::column_sign(c));
  }
  const int variables = 1 + *std::max_element(ties.variable.begin(), ties.variable.end());
  ties.range.assign(variables, {-INFINITY, INFINITY});
  for (int c = 0; c < columns; ++c) {
    AngleRange& range = ties.range[ties.variable[c]];
    range.lower = std::max(range.lower, ties.sign[c] > 0 ? beta.lower : -beta.upper);
    range.upper = std::min(range.upper, ties.sign[c] > 0 ? beta.upper : -beta.lower);
  }
  for (const AngleRange& range : ties.range)
    if (!(range.lower < range.upper))
      throw InvalidInput("the tied columns tilt both ways, and the range leaves them nothing in common");
  return ties;
}

std::vector<TiltTie> tied_tilts(const model::Structure& strip, const BendTies& ties) {
  std::vector<TiltTie> out;
  std::map<int, std::size_t> at;  // variable to its index in `out`
  for (TiltTie& line : tilt_ties(strip)) {
    const int column = line_of(strip.hinges[line.hinges.front()].wall);
    const auto [place, is_new] = at.try_emplace(ties.variable[column], out.size());
    if (is_new) {
      line.range = range_of_size(strip, ties, column);
      out.push_back(std::move(line));
      continue;
    }
    TiltTie& tie = out[place->second];
    tie.hinges.insert(tie.hinges.end(), line.hinges.begin(), line.hinges.end());
    tie.signs.insert(tie.signs.end(), line.signs.begin(), line.signs.end());
  }
  return out;
}

namespace {

using Eigen::Vector2d;

Vector2d xz(const Eigen::Vector3d& v) { return {v.x(), v.z()}; }

}  // namespace

std::vector<Vector2d> midline(const model::State& lattice, int rows) {
  std::vector<Vector2d> points;
  for (int c = 0; c < model::vertex_columns(lattice.size(), rows); ++c)
    points.push_back(xz(lattice[model::lattice_body({c, 0}, rows)].p));
  return points;
}

CurveFit::CurveFit(const targets::Curve& goal, BendTies ties, double cell_mm, AngleRange theta)
    : goal_(goal), ties_(std::move(ties)), cell_mm_(cell_mm) {
  const double infinity = std::numeric_limits<double>::infinity();
  lower_ = Eigen::VectorXd::Constant(variables(), -infinity);
  upper_ = Eigen::VectorXd::Constant(variables(), infinity);
  for (int k = 0; k < ties_.variables(); ++k) {
    lower_[k] = std::tan(ties_.range[k].lower);
    upper_[k] = std::tan(ties_.range[k].upper);
  }
  lower_[ties_.variables()] = theta.lower;
  upper_[ties_.variables()] = theta.upper;
}

model::ExactDesign<double> CurveFit::design(const Eigen::VectorXd& x, int rows) const {
  // basic() refuses the chain without rows that the search folds.
  const auto columns = static_cast<std::size_t>(ties_.columns());
  model::ExactDesign<double> design{std::vector<double>(columns, 0.0), std::vector<double>(columns, 0.5),
                                    std::vector<double>(static_cast<std::size_t>(rows), 0.5), 0, 0};
  for (int c = 0; c < ties_.columns(); ++c) design.beta[c] = ties_.sign[c] * std::atan(x[ties_.variable[c]]);
  design.theta = theta(x);
  return design;
}

Eigen::VectorXd CurveFit::pack(const std::vector<double>& bends, double theta) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(variables());
  Eigen::VectorXd members = Eigen::VectorXd::Zero(variables());
  for (int c = 0; c < ties_.columns(); ++c) {
    x[ties_.variable[c]] += std::tan(bends[c]);
    members[ties_.variable[c]] += 1;
  }
  for (int k = 0; k < ties_.variables(); ++k) x[k] /= members[k];
  x[ties_.variables()] = theta;
  x = x.cwiseMax(lower_).cwiseMin(upper_);

  model::State lattice;
  fold_unchecked(design(x, 0), cell_mm_, lattice);
  const auto points = midline(lattice, 0);
  const Vector2d goal_chord = goal_.points().back() - goal_.points().front();
  const Vector2d chord = points.back() - points.front();
  const double heading = std::atan2(goal_chord.y(), goal_chord.x()) - std::atan2(chord.y(), chord.x());
  const Vector2d middle = (goal_.points().back() + goal_.points().front()) / 2;
  const Vector2d origin = middle - Eigen::Rotation2Dd(heading) * ((points.back() + points.front()) / 2);
  x.tail<3>() << heading, origin / goal_.diagonal();
  return x;
}

/// Folded midline in the goal's plane, with the derivatives of its points.
class CurveFit::Frame {
 public:
  Frame(const CurveFit& fit, const Eigen::VectorXd& x, bool with_jacobian) : fit_(fit), x_(x) {
    const auto design = fit.design(x, 0);
    if (with_jacobian)
      fold_with_jacobian(design, fit.cell_mm_, lattice_, jacobian_);
    else
      fold_unchecked(design, fit.cell_mm_, lattice_);
    turn_ = Eigen::Rotation2Dd(x[x.size() - 3]).toRotationMatrix();
    origin_ = fit.goal_.diagonal() * x.tail<2>();
    for (const model::Pose& pose : lattice_) {
      points_.push_back(turn_ * xz(pose.p) + origin_);
      arc_.push_back(arc_.empty() ? 0.0
                                  : arc_.back() + (points_.back() - points_[points_.size() - 2]).norm());
    }
  }

  int chords() const { return static_cast<int>(points_.size()) - 1; }
  Vector2d place(int chord, double f) const { return (1 - f) * points_[chord] + f * points_[chord + 1]; }

  /// Returns the closest point on the goal, sought from the place's fraction of the arc length.
  targets::ClosestPoint closest(int chord, double f) const {
    const targets::Curve& goal = fit_.goal_;
    const double fraction = ((1 - f) * arc_[chord] + f * arc_[chord + 1]) / arc_.back();
    return targets::closest_near(goal.points(), goal.segment_at(fraction * goal.length()), place(chord, f));
  }

  /// Adds weight times the rate of direction . place to a row of the Jacobian.
  template <class Row>
  void add_derivatives(int chord, double f, const Vector2d& direction, double weight, Row row) const {
    const BendTies& ties = fit_.ties_;
    const Vector2d local = weight * (turn_.transpose() * direction);
    const auto rate = [&](int parameter) {
      const Vector2d v =
          (1 - f) * xz(jacobian_.twist(parameter, chord).v) + f * xz(jacobian_.twist(parameter, chord + 1).v);
      return local.dot(v);
    };
    for (int c = 0; c <= chord; ++c) {
      const double u = x_[ties.variable[c]];
      row[ties.variable[c]] += ties.sign[c] / (1 + u * u) * rate(jacobian_.beta(c));
    }
    const int theta_at = ties.variables();
    row[theta_at] += rate(jacobian_.theta());
    row[theta_at + 1] += weight * direction.dot(targets::left_of(place(chord, f) - origin_));
    row[theta_at + 2] += weight * fit_.goal_.diagonal() * direction.x();
    row[theta_at + 3] += weight * fit_.goal_.diagonal() * direction.y();
  }

 private:
  const CurveFit& fit_;
  const Eigen::VectorXd& x_;
  std::vector<Vector2d> points_;
  std::vector<double> arc_;
  Eigen::Matrix2d turn_;
  Vector2d origin_;
  model::State lattice_;
  model::ExactJacobian jacobian_;
};

bool CurveFit::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const {
  if (!x.allFinite()) return false;
  const Frame frame(*this, x, J != nullptr);
  const double weight = 1 / (goal_.diagonal() * std::sqrt(static_cast<double>(residuals())));
  r.resize(residuals());
  if (J) J->setZero(residuals(), variables());

  int row = 0;
  const auto add = [&](int chord, double f, double distance, const Vector2d& direction) {
    r[row] = weight * distance;
    if (J) frame.add_derivatives(chord, f, direction, weight, J->row(row));
    ++row;
  };
  for (int chord = 0; chord < frame.chords(); ++chord)
    for (int k = 0; k < places_per_cell; ++k) {
      const double f = (k + 0.5) / places_per_cell;
      const targets::ClosestPoint closest = frame.closest(chord, f);
      add(chord, f, closest.distance, closest.normal);
    }
  const Vector2d first_miss = frame.place(0, 0.0) - goal_.points().front();
  const Vector2d last_miss = frame.place(frame.chords() - 1, 1.0) - goal_.points().back();
  for (const Vector2d& axis : {Vector2d(1, 0), Vector2d(0, 1)}) {
    add(0, 0.0, axis.dot(first_miss), axis);
    add(frame.chords() - 1, 1.0, axis.dot(last_miss), axis);
  }
  return r.allFinite() && (!J || J->allFinite());
}

}  // namespace kinetix::optim
