#pragma once

#include <Eigen/Core>

#include "model/base/rotation_vector.hpp"

namespace kinetix::model {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Energy between two bodies with its derivatives by their twists: a's turn omega (rad), a's shift (cell
/// edges), then b's, as in model/closure/closure.hpp. The Hessian is that of the energy after each body has
/// turned by exp(omega). The producer of the element defines its unit: k_point edge^2 for a hinge.
struct Element {
  double energy = 0;
  Vector12 gradient = Vector12::Zero();
  Matrix12 hessian = Matrix12::Zero();
};

/// Returns the Hessian by omega of f . (exp(omega) arm) at omega = 0.
inline Eigen::Matrix3d turning_hessian(const Eigen::Vector3d& f, const Eigen::Vector3d& arm) {
  Eigen::Matrix3d m = 0.5 * (f * arm.transpose() + arm * f.transpose());
  m.diagonal().array() -= f.dot(arm);
  return m;
}

}  // namespace kinetix::model
