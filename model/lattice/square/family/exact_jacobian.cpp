#include "model/lattice/square/family/exact_jacobian.hpp"

#include <Eigen/Geometry>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

Vector3d mirror_y(const Vector3d& v) { return {v.x(), -v.y(), v.z()}; }

/// Returns the rate at which the projection of `axis` to the xz plane turns about +y if the axis changes by `rate`.
double turn_about_y(const Vector3d& axis, const Vector3d& rate) {
  return (axis.z() * rate.x() - axis.x() * rate.z()) / (axis.x() * axis.x() + axis.z() * axis.z());
}

struct ColumnHinge {
  double cos_beta, sin_beta, t;
  Vector3d axis;  // carried
};

ColumnHinge column_hinge(const ExactDesign<double>& design, const Pose& pose, int c) {
  const double cb = std::cos(design.beta[c]), sb = std::sin(design.beta[c]);
  return {cb, sb, fraction_from_lower(design.t[c], {c, 0}), carried_axis(pose.R, cb, sb)};
}

Twist neighbour_x(const Twist& twist, const Pose& pose, const Pose& next, const ColumnHinge& hinge,
                  double L) {
  const MirrorPlane<double> mirror(hinge.axis);
  const double turn = turn_about_y(hinge.axis, twist.omega.cross(hinge.axis));
  Twist out;
  out.omega = 2 * turn * Vector3d::UnitY() - mirror.reflect(twist.omega);
  out.v = twist.v +
          L * (hinge.t * twist.omega.cross(pose.R.col(0)) + (1 - hinge.t) * out.omega.cross(next.R.col(0)));
  return out;
}

Twist neighbour_y(const Twist& twist, const Pose& pose, const Pose& next, double s, double L) {
  Twist out;
  out.omega = -mirror_y(twist.omega);
  out.v = twist.v + L * (s * twist.omega.cross(pose.R.col(1)) + (1 - s) * out.omega.cross(next.R.col(1)));
  return out;
}

/// Fills the bodies of a lattice by the recursion of fold(), from the twist of body (0,0).
void propagate(const ExactDesign<double>& design, double L, const State& poses,
               const std::vector<ColumnHinge>& hinges, const Twist& first, Twist* twists) {
  const int columns = design.columns(), stride = design.rows() + 1;
  twists[0] = first;
  for (int i = 0; i <= columns; ++i) {
    const int b = i * stride;
    for (int j = 0; j + 1 < stride; ++j)
      twists[b + j + 1] = neighbour_y(twists[b + j], poses[b + j], poses[b + j + 1],
                                      fraction_from_lower(design.s[j], {i, j}), L);
    if (i < columns) twists[b + stride] = neighbour_x(twists[b], poses[b], poses[b + stride], hinges[i], L);
  }
}

}  // namespace

void ExactJacobian::resize(int columns, int rows) {
  if (columns == columns_ && rows == rows_) return;
  columns_ = columns;
  rows_ = rows;
  twists_.assign(index(parameters(), 0), Twist{});
}

void fold_with_jacobian(const ExactDesign<double>& design, double L, State& poses, ExactJacobian& jacobian) {
  const int columns = design.columns(), rows = design.rows(), stride = rows + 1;
  fold_unchecked(design, L, poses);
  jacobian.resize(columns, rows);
  const int bodies = jacobian.bodies();

  std::vector<ColumnHinge> hinges(columns);
  for (int c = 0; c < columns; ++c) {
    const Pose& pose = poses[c * stride];
    const Pose& next = poses[(c + 1) * stride];
    const ColumnHinge& h = hinges[c] = column_hinge(design, pose, c);
    const Vector3d axis_rate = -h.sin_beta * pose.R.col(2) - h.cos_beta * pose.R.col(1);
    const double turn = 2 * turn_about_y(h.axis, axis_rate);
    const Vector3d point = pose.p + h.t * L * pose.R.col(0);
    const Vector3d shift = Vertex{c, 0}.sense() * L * (pose.R.col(0) - next.R.col(0));
    Twist* by_beta = jacobian.row(jacobian.beta(c));
    Twist* by_t = jacobian.row(jacobian.t(c));
    for (int b = (c + 1) * stride; b < bodies; ++b) {
      const Vector3d arm = poses[b].p - point;
      by_beta[b] = {{0, turn, 0}, {turn * arm.z(), 0, -turn * arm.x()}};
      by_t[b].v = shift;
    }
  }

  for (int r = 0; r < rows; ++r)
    for (int i = 0; i <= columns; ++i) {
      const int b = i * stride + r;
      const Vector3d shift = Vertex{i, r}.sense() * L * (poses[b].R.col(1) - poses[b + 1].R.col(1));
      Twist* by_s = jacobian.row(jacobian.s(r)) + i * stride;
      for (int j = r + 1; j < stride; ++j) by_s[j].v = shift;
    }

  const Vector3d row_axis = wall_up(Axis::y, design.gamma);
  const Vector3d y = Vector3d::UnitY();
  propagate(design, L, poses, hinges, {row_axis, Vector3d::Zero()}, jacobian.row(jacobian.theta()));
  propagate(design, L, poses, hinges, {y - poses[0].R * y, Vector3d::Zero()}, jacobian.row(jacobian.gamma()));
}

}  // namespace kinetix::model
