#pragma once

#include "model/hinge/element.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// The length of a cord through hinge points (model/linkage/actuators.hpp) with its derivatives by the twists of the bodies
/// that carry them, ordered as in Element: six numbers a body, in the order of `bodies`. Lengths are in cell edges. Two
/// neighbouring points less than 1e-9 cell edges apart have no direction, and count as a piece that does not change.
struct CordElement {
  double length = 0;
  std::vector<int> bodies;  ///< ascending
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;  ///< after each body has turned by exp(omega), as that of an Element
};

CordElement cord_element(const Linkage& linkage, const std::vector<int>& through, const State& state);

/// The gradient by the coordinates of all bodies.
Eigen::VectorXd cord_gradient(const Linkage& linkage, const std::vector<int>& through, const State& state);

/// How a number changes with the place of the k-th hinge point on its wall: by t (fraction) and by the offset (cell edges).
using PointGradients = Eigen::Matrix2Xd;

/// Of the length of a cord, and of its derivative along given twists of all bodies (rad, cell edges).
struct CordGradients {
  PointGradients length, along;  ///< column k: hinge through[k]
};
CordGradients cord_gradients(const Linkage& linkage, const std::vector<int>& through, const State& state,
                             const Eigen::VectorXd& twists);

}  // namespace kinetix::model
