#pragma once

#include <Eigen/Geometry>

#include "model/hinge/element.hpp"

namespace kinetix::model {

/// Signed distance n . m - offset of a point on one body from a face of another body, in cell edges.
struct PointGap {
  Eigen::Vector3d n;  ///< outward normal, turned with its body
  Eigen::Vector3d a;  ///< from the point's body to the point
  Eigen::Vector3d m;  ///< from the face's body to the point
  double value = 0;

  /// Returns the gradient by the twists of both bodies, first that of the point, ordered as in Element.
  Vector12 gradient() const {
    Vector12 g;
    g << a.cross(n), n, n.cross(m), -n;
    return g;
  }

  Matrix12 hessian() const {
    const Eigen::Matrix3d cross_n = cross_matrix(n), turns = -cross_n * cross_matrix(a);
    Matrix12 h = Matrix12::Zero();
    h.block<3, 3>(0, 0) = turning_hessian(n, a);
    h.block<3, 3>(6, 6) = turning_hessian(m, n);
    h.block<3, 3>(6, 3) = cross_n;
    h.block<3, 3>(3, 6) = -cross_n;
    h.block<3, 3>(6, 9) = -cross_n;
    h.block<3, 3>(9, 6) = cross_n;
    h.block<3, 3>(6, 0) = turns;
    h.block<3, 3>(0, 6) = turns.transpose();
    return h;
  }

  /// Returns the change of gradient() if n, a and m change.
  Vector12 gradient_change(const Eigen::Vector3d& dn, const Eigen::Vector3d& da,
                           const Eigen::Vector3d& dm) const {
    Vector12 g;
    g << da.cross(n) + a.cross(dn), dn, dn.cross(m) + n.cross(dm), -dn;
    return g;
  }

  /// Returns 1/2 k value^2 with its derivatives.
  Element pressed(double k) const {
    const Vector12 by_twists = gradient();
    Element e;
    e.energy = 0.5 * k * value * value;
    e.gradient = k * value * by_twists;
    e.hessian = k * (by_twists * by_twists.transpose() + value * hessian());
    return e;
  }
};

}  // namespace kinetix::model
