#include "model/hinge/mismatch_energy.hpp"

#include <Eigen/Geometry>

namespace kinetix::model {

using Eigen::Matrix3d;

void add_turning(const Mismatch& m, double weight, Element& e) {
  const Matrix3d a = cross_matrix(m.lower), b = cross_matrix(m.upper);
  e.energy += weight * m.gap.squaredNorm();
  e.gradient.segment<3>(0) += 2 * weight * m.lower.cross(m.gap);
  e.gradient.segment<3>(6) -= 2 * weight * m.upper.cross(m.gap);
  e.hessian.block<3, 3>(0, 0) += 2 * weight * (turning_hessian(m.gap, m.lower) - a * a);
  e.hessian.block<3, 3>(6, 6) -= 2 * weight * (turning_hessian(m.gap, m.upper) + b * b);
  const Matrix3d coupling = 2 * weight * (a * b);
  e.hessian.block<3, 3>(0, 6) += coupling;
  e.hessian.block<3, 3>(6, 0) += coupling.transpose();
}

void add_shifts(const Mismatch& m, double weight, Element& e) {
  const double twice = 2 * weight;
  const Matrix3d a = twice * cross_matrix(m.lower), b = twice * cross_matrix(m.upper);
  e.gradient.segment<3>(3) += twice * m.gap;
  e.gradient.segment<3>(9) -= twice * m.gap;
  e.hessian.block<3, 3>(0, 3) += a;
  e.hessian.block<3, 3>(3, 0) -= a;
  e.hessian.block<3, 3>(0, 9) -= a;
  e.hessian.block<3, 3>(9, 0) += a;
  e.hessian.block<3, 3>(6, 3) -= b;
  e.hessian.block<3, 3>(3, 6) += b;
  e.hessian.block<3, 3>(6, 9) += b;
  e.hessian.block<3, 3>(9, 6) -= b;
  for (int k = 0; k < 3; ++k) {
    e.hessian(3 + k, 3 + k) += twice;
    e.hessian(9 + k, 9 + k) += twice;
    e.hessian(3 + k, 9 + k) -= twice;
    e.hessian(9 + k, 3 + k) -= twice;
  }
}

}  // namespace kinetix::model
