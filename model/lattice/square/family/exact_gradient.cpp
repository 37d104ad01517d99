#include "model/lattice/square/family/exact_gradient.hpp"

#include <cmath>

namespace kinetix::model {
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
