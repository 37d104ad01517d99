#include "optim/surface/fit_surface.hpp"

#include <ceres/jet.h>

#include <limits>

#include "model/base/decompositions.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int cone_variables = 6;   // two turns of the axis, two shifts of it, radius, half angle
constexpr int cone_directions = 8;  // of the axis in the points' plane, from which the search starts
constexpr int min_points =
    16;  // per side of the whole grid: fits then have as many points as a picture shows
// Relative to the points' size: radius at the start if they hardly bend.
constexpr double flat_radius = 20;
constexpr double no_cone = 1e-6;  // sine of a half angle: the tip is then a million sizes away

/// Returns the points in the frame of their plane: x and y in it, the origin in their middle, of size 1.
std::vector<Vector3d> levelled(const std::vector<Vector3d>& points, double& size) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::Matrix3d axes = symmetric_eigenvectors(spread).vectors.rowwise().reverse();
  size = std::sqrt(spread.trace() / static_cast<double>(points.size()));
  std::vector<Vector3d> out;
  for (const Vector3d& p : points) out.push_back(axes.transpose() * (p - middle) / size);
  return out;
}

/// Distances of points from a cone. The search starts from a cylinder.
class ConeProblem final : public LeastSquaresProblem {
 public:
  /// @param widens whether it may be a cone; otherwise it is a cylinder
  ConeProblem(const std::vector<Vector3d>& points, const Vector3d& axis, double radius, bool widens)
      : points_(points),
        axis_(axis),
        across_(Vector3d::UnitZ().cross(axis)),
        radius_(radius),
        widens_(widens) {
    constexpr double none = std::numeric_limits<double>::infinity();
    lower_ = VectorXd::Constant(variables(), -none);
    upper_ = VectorXd::Constant(variables(), none);
  }

  int variables() const override { return widens_ ? cone_variables : cone_variables - 1; }
  int residuals() const override { return static_cast<int>(points_.size()); }
  const VectorXd& lower() const override { return lower_; }
  const VectorXd& upper() const override { return upper_; }

  bool evaluate(const VectorXd& x, VectorXd& r, Eigen::MatrixXd* J) const override {
    using Dual = ceres::Jet<double, cone_variables>;
    Dual at[cone_variables];
    for (int k = 0; k < variables(); ++k) at[k] = Dual(x[k], k);
    const Vector<Dual> a = axis_at(at), b = place_at(at);
    r.resize(residuals());
    if (J) J->resize(residuals(), variables());
    for (int k = 0; k < residuals(); ++k) {
      const Vector<Dual> w = points_[k].cast<Dual>() - b;
      const Dual d = cos(at[5]) * w.cross(a).norm() - sin(at[5]) * w.dot(a) - radius_at(at);
      r[k] = d.a;
      if (J) J->row(k) = d.v.head(variables()).transpose();
    }
    return r.allFinite() && (!J || J->allFinite());
  }

  /// Returns whether the tip of the cone is over the points, where a sheet that bends in one direction cannot
  /// have one. Seen from the tip, in their plane, the points then span more than half a turn.
  bool has_tip_inside(const VectorXd& x) const {
    const double sine = widens_ ? std::sin(x[5]) : 0;
    if (std::abs(sine) < no_cone) return false;
    const Vector3d tip = place_at(x.data()) - radius_at(x.data()) / sine * axis_at(x.data());
    std::vector<double> angles;
    for (const Vector3d& p : points_) angles.push_back(std::atan2(p.y() - tip.y(), p.x() - tip.x()));
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 2 * pi - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k) gap = std::max(gap, angles[k] - angles[k - 1]);
    return !(gap > pi);
  }

 private:
  template <class T>
  using Vector = Eigen::Matrix<T, 3, 1>;

  template <class T>
  Vector<T> axis_at(const T* x) const {
    return (axis_.cast<T>() + x[0] * across_.cast<T>() + x[1] * Vector3d::UnitZ().cast<T>()).normalized();
  }
  template <class T>
  Vector<T> place_at(const T* x) const {
    return x[2] * across_.cast<T>() + (T(-radius_) + x[3]) * Vector3d::UnitZ().cast<T>();
  }
  /// Returns the radius about place_at(x); the points are above or below that place.
  template <class T>
  T radius_at(const T* x) const {
    return T(std::abs(radius_)) + x[4];
  }

  const std::vector<Vector3d>& points_;
  Vector3d axis_, across_;
  double radius_;
  bool widens_;
  VectorXd lower_, upper_;
};

/// Returns the radius R of the parabola z = -y^2 / (2 R) across a direction, negative if it bends upwards.
double radius_across(const std::vector<Vector3d>& points, const Vector3d& axis) {
  const Vector3d across = Vector3d::UnitZ().cross(axis);
  Eigen::MatrixXd A(points.size(), 3);
  VectorXd z(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double y = across.dot(points[k]);
    A.row(static_cast<int>(k)) << 1, y, y * y;
    z[static_cast<int>(k)] = points[k].z();
  }
  const double bend = least_squares(A, z)[2];
  const double radius = -1 / (2 * bend);
  return std::abs(radius) <= flat_radius ? radius : std::copysign(flat_radius, radius);
}

}  // namespace

targets::PointGrid middle_of(const SurfaceDesign& design) {
  const model::QuadMesh& m = design.mesh;
  targets::PointGrid out{m.columns - 1, m.rows - 1, {}};
  for (int j = 0; j < m.rows; ++j)
    for (int i = 0; i < m.columns; ++i)
      out.points.push_back((design.vertices[m.vertex(i, j)] + design.vertices[m.vertex(i + 1, j)] +
                            design.vertices[m.vertex(i, j + 1)] + design.vertices[m.vertex(i + 1, j + 1)]) /
                           4);
  return out;
}

std::vector<Vector3d> points_below(const targets::SurfacePatch& surface, const targets::PointGrid& grid) {
  std::vector<Vector3d> out;
  const auto parts_of = [](int facets) { return (min_points + facets - 1) / facets; };
  const int across = parts_of(grid.columns), along = parts_of(grid.rows);
  const int columns = across * grid.columns, rows = along * grid.rows;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const int column = std::min(i / across, grid.columns - 1), row = std::min(j / along, grid.rows - 1);
      const double u = static_cast<double>(i) / across - column, v = static_cast<double>(j) / along - row;
      const Vector3d p = (1 - v) * ((1 - u) * grid.at(column, row) + u * grid.at(column + 1, row)) +
                         v * ((1 - u) * grid.at(column, row + 1) + u * grid.at(column + 1, row + 1));
      const Vector2d at = closest_surface_point(surface, p).at;
      if (std::abs(at.x()) <= surface.half.x() && std::abs(at.y()) <= surface.half.y())
        out.emplace_back(at.x(), at.y(), surface.height(at).z);
    }
  return out;
}

double rms_from_best_cone(const std::vector<Vector3d>& points) {
  double size = 1, least = std::numeric_limits<double>::infinity();
  const std::vector<Vector3d> level = levelled(points, size);
  SolverOptions options;
  options.tolerance = 1e-9;
  for (int k = 0; k < cone_directions; ++k) {
    const double angle = pi * k / cone_directions;
    const Vector3d axis(std::cos(angle), std::sin(angle), 0);
    for (const bool widens : {false, true}) {
      const ConeProblem problem(level, axis, radius_across(level, axis), widens);
      const SolveResult found = solve(problem, VectorXd::Zero(problem.variables()), options);
      if (!problem.has_tip_inside(found.x)) least = std::min(least, found.residual_norm);
    }
  }
  return least * size / std::sqrt(static_cast<double>(points.size()));
}

}  // namespace kinetix::optim
