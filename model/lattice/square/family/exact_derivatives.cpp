#include "model/lattice/square/family/exact_derivatives.hpp"

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

namespace {

using std::cos;
using std::sin;

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using VectorX = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// Generalised force on a body: its product with a twist is the change of the function.
template <class T>
struct Pull {
  Vector3<T> moment = Vector3<T>::Zero();  ///< about the body's position
  Vector3<T> force = Vector3<T>::Zero();

  static Pull on(const VectorX<T>& by_state, int body) {
    return {by_state.template segment<3>(6 * body), by_state.template segment<3>(6 * body + 3)};
  }
};

// Written by entry: Eigen has no vector instructions for lanes, and its expressions hinder the compiler.
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// Adds the force on the y-neighbour of a body to the body, since both move together. @return derivative by the
/// hinge's fraction from the body
template <class T>
T add_neighbour_y(const Pull<T>& next, const PoseOf<T>& pose, const PoseOf<T>& next_pose, const T& s,
                  double L, Pull<T>& pull) {
  const Vector3<T> y = pose.R.col(1), next_y = next_pose.R.col(1);
  const T near = s * T(L), far = T(L) - near;
  const Vector3<T> m = next.moment + far * cross<T>(next_y, next.force), own = near * cross<T>(y, next.force);
  pull.moment += Vector3<T>(own.x() - m.x(), own.y() + m.y(), own.z() - m.z());
  pull.force += next.force;
  return T(L) * dot<T>(next.force, y - next_y);
}

/// Derivatives by the tilt of a hinge and by its fraction from the body.
template <class T>
struct ByHinge {
  T beta, t;
};

/// Adds the force on the x-neighbour of a body to the body, over the hinge of their wall. @return derivatives by the
/// hinge
template <class T>
ByHinge<T> add_neighbour_x(const Pull<T>& next, const PoseOf<T>& pose, const PoseOf<T>& next_pose,
                           const T& beta, const T& t, double L, Pull<T>& pull) {
  const T cb = cos(beta), sb = sin(beta);
  const Vector3<T> axis = carried_axis<T>(pose.R, cb, sb);
  const T twice_over = T(2) / (axis.x() * axis.x() + axis.z() * axis.z());
  const Vector3<T> x = pose.R.col(0), next_x = next_pose.R.col(0);
  const T near = t * T(L), far = T(L) - near;
  const Vector3<T> m = next.moment + far * cross<T>(next_x, next.force), own = near * cross<T>(x, next.force);
  // A turn omega of the body turns the mirror plane about y. The turn is (-axis.y axis.x, |axis|^2 - axis.y^2,
  // -axis.y axis.z) . omega divided by the second of these.
  const T turning = axis.y() * m.y() * twice_over,
          mirrored = (axis.z() * m.x() - axis.x() * m.z()) * twice_over;
  pull.moment += Vector3<T>(own.x() + mirrored * axis.z() - turning * axis.x() - m.x(), own.y() + m.y(),
                            own.z() - mirrored * axis.x() - turning * axis.z() - m.z());
  pull.force += next.force;
  const T rate_x = -sb * pose.R(0, 2) - cb * pose.R(0, 1), rate_z = -sb * pose.R(2, 2) - cb * pose.R(2, 1);
  return {(axis.z() * rate_x - axis.x() * rate_z) * twice_over * m.y(),
          T(L) * dot<T>(next.force, x - next_x)};
}

template <class T>
void resize(int columns, int rows, ExactDesign<T>& gradient) {
  gradient.beta.resize(columns);
  gradient.t.resize(columns);
  gradient.s.assign(rows, T(0));
}

}  // namespace

template <class T>
void fold_gradient(const ExactDesign<T>& design, double L, const std::vector<PoseOf<T>>& poses,
                   const Eigen::Matrix<T, Eigen::Dynamic, 1>& by_state, ExactDesign<T>& gradient) {
  const int columns = design.columns(), rows = design.rows(), stride = rows + 1;
  resize(columns, rows, gradient);
  Pull<T> beyond;  // force on the first body of the column to the right
  for (int i = columns; i >= 0; --i) {
    const int first = i * stride;
    Pull<T> pull = Pull<T>::on(by_state, first + rows);
    for (int j = rows - 1; j >= 0; --j) {
      const int b = first + j;
      Pull<T> below = Pull<T>::on(by_state, b);
      const T s = fraction_from_lower(design.s[j], {i, j});
      gradient.s[j] += T(Vertex{i, j}.sense()) * add_neighbour_y(pull, poses[b], poses[b + 1], s, L, below);
      pull = below;
    }
    if (i < columns) {
      const T t = fraction_from_lower(design.t[i], {i, 0});
      const ByHinge<T> by =
          add_neighbour_x(beyond, poses[first], poses[first + stride], design.beta[i], t, L, pull);
      gradient.beta[i] = by.beta;
      gradient.t[i] = T(Vertex{i, 0}.sense()) * by.t;
    }
    beyond = pull;
  }
  const auto& R = poses[0].R;
  gradient.theta = dot<T>({sin(design.gamma), T(0), cos(design.gamma)}, beyond.moment);
  gradient.gamma = dot<T>({-R(0, 1), T(1) - R(1, 1), -R(2, 1)}, beyond.moment);
}

template void fold_gradient(const ExactDesign<double>&, double, const State&, const Eigen::VectorXd&,
                            ExactDesign<double>&);
template void fold_gradient(const ExactDesign<Lanes>&, double, const std::vector<PoseOf<Lanes>>&,
                            const Eigen::Matrix<Lanes, Eigen::Dynamic, 1>&, ExactDesign<Lanes>&);

}  // namespace kinetix::model
