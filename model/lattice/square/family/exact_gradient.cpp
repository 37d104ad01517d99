#include "model/lattice/square/family/exact_gradient.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

/// What pulls at a body: pairs with a twist to the change of the function.
struct Pull {
  Vector3d moment = Vector3d::Zero();  ///< about the body's position
  Vector3d force = Vector3d::Zero();
};

Pull pull_on(const Eigen::VectorXd& by_state, int body) {
  return {by_state.segment<3>(6 * body), by_state.segment<3>(6 * body + 3)};
}

/// Moves to a body what pulls at its y-neighbour, which moves with it. @return by the hinge's fraction from the body
double add_neighbour_y(const Pull& next, const Pose& pose, const Pose& next_pose, double s, double L,
                       Pull& pull) {
  const Vector3d moment = next.moment + (1 - s) * L * next_pose.R.col(1).cross(next.force);
  pull.moment += s * L * pose.R.col(1).cross(next.force) + Vector3d(-moment.x(), moment.y(), -moment.z());
  pull.force += next.force;
  return L * next.force.dot(pose.R.col(1) - next_pose.R.col(1));
}

/// By the tilt of a hinge and by its fraction from the body.
struct ByHinge {
  double beta = 0, t = 0;
};

/// The same over a hinge of an x-wall.
ByHinge add_neighbour_x(const Pull& next, const Pose& pose, const Pose& next_pose, double beta, double t,
                        double L, Pull& pull) {
  const double cb = std::cos(beta), sb = std::sin(beta);
  const Vector3d axis = carried_axis(pose.R, cb, sb);
  const double over = 1 / (axis.x() * axis.x() + axis.z() * axis.z());
  const Vector3d m = next.moment + (1 - t) * L * next_pose.R.col(0).cross(next.force);
  // The mirror plane turns about y by (-axis.y axis.x over, 1, -axis.y axis.z over) . omega where the body turns by omega.
  const double turning = 2 * axis.y() * m.y() * over,
               mirrored = 2 * (axis.z() * m.x() - axis.x() * m.z()) * over;
  pull.moment += t * L * pose.R.col(0).cross(next.force) +
                 Vector3d(mirrored * axis.z() - turning * axis.x() - m.x(), m.y(),
                          -mirrored * axis.x() - turning * axis.z() - m.z());
  pull.force += next.force;
  const Vector3d rate = -sb * pose.R.col(2) - cb * pose.R.col(1);
  return {2 * (axis.z() * rate.x() - axis.x() * rate.z()) * over * m.y(),
          L * next.force.dot(pose.R.col(0) - next_pose.R.col(0))};
}

void resize(int columns, int rows, ExactDesign<double>& gradient) {
  gradient.beta.assign(columns, 0);
  gradient.t.assign(columns, 0);
  gradient.s.assign(rows, 0);
}

}  // namespace

void fold_gradient(const ExactDesign<double>& design, double L, const State& poses,
                   const Eigen::VectorXd& by_state, ExactDesign<double>& gradient) {
  const int columns = design.columns(), rows = design.rows(), stride = rows + 1;
  resize(columns, rows, gradient);
  Pull beyond;  // what pulls at the first body of the column to the right
  for (int i = columns; i >= 0; --i) {
    const int first = i * stride;
    Pull pull = pull_on(by_state, first + rows);
    for (int j = rows - 1; j >= 0; --j) {
      const int b = first + j;
      Pull below = pull_on(by_state, b);
      const double s = fraction_from_lower(design.s[j], {i, j});
      gradient.s[j] += Vertex{i, j}.sense() * add_neighbour_y(pull, poses[b], poses[b + 1], s, L, below);
      pull = below;
    }
    if (i < columns) {
      const double t = fraction_from_lower(design.t[i], {i, 0});
      const ByHinge by =
          add_neighbour_x(beyond, poses[first], poses[first + stride], design.beta[i], t, L, pull);
      gradient.beta[i] = by.beta;
      gradient.t[i] = Vertex{i, 0}.sense() * by.t;
    }
    beyond = pull;
  }
  const Vector3d y = Vector3d::UnitY();
  gradient.theta = wall_up(Axis::y, design.gamma).dot(beyond.moment);
  gradient.gamma = (y - poses[0].R * y).dot(beyond.moment);
}

}  // namespace kinetix::model
