#pragma once

#include "model/hinge/element.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Length of a tendon through hinge points (model/linkage/linkage_drive.hpp) in cell edges, with its derivatives
/// by the twists of the bodies that carry the points. Derivatives are ordered as in Element: six numbers per
/// body, in the order of `bodies`. Neighbouring points closer than 1e-9 cell edges have no direction; the
/// length of their piece counts as constant.
struct CordElement {
  double length = 0;
  std::vector<int> bodies;  ///< ascending
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;  ///< after each body has turned by exp(omega), as that of an Element
};

CordElement cord_element(const Linkage& linkage, const std::vector<int>& through, const State& state);

/// Returns the gradient of the length by the coordinates of all bodies.
Eigen::VectorXd cord_gradient(const Linkage& linkage, const std::vector<int>& through, const State& state);

/// Derivatives by the position of each hinge point on its wall: column k by t (fraction) and offset (cell
/// edges).
using PointGradients = Eigen::Matrix2Xd;

/// Derivatives of the length of a tendon, and of its change along given twists of all bodies (rad, cell
/// edges).
struct CordGradients {
  PointGradients length, along;  ///< column k: hinge through[k]
};
CordGradients cord_gradients(const Linkage& linkage, const std::vector<int>& through, const State& state,
                             const Eigen::VectorXd& twists);

}  // namespace kinetix::model
