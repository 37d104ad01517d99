#pragma once

#include <vector>

#include "model/lattice/square/structure.hpp"
#include "optim/solvers/variables.hpp"

namespace kinetix::optim {

/// Which hinges of a rectangular panel share a variable for t, so that the flat panel looks the same after a
/// motion of the plane: hinge h has t = x[variable[h]], or 1 - x[variable[h]] where the motion turns its wall
/// end to end. A wall that it turns onto itself keeps t = 0.5: `centred`.
struct HingeTies {
  static constexpr int centred = -1;  ///< in place of an index: no variable has the number
  std::vector<int> variable;
  std::vector<bool> reversed;
  int variables = 0;

  Eigen::VectorXd expand(const Eigen::VectorXd& x) const;
  /// The gradient by x of a function whose gradient by t of all hinges is given.
  Eigen::VectorXd gather(const Eigen::VectorXd& by_t) const;
  /// t, but 1 - t of hinges that would be on the other side of the middle than the first that shares their variable: on
  /// panels of odd sides a motion takes class A to class B, and what a picture asks of both would cancel.
  Eigen::VectorXd to_one_side(Eigen::VectorXd t) const;
  /// x of which expand() is nearest to t, least squares.
  Eigen::VectorXd nearest(const Eigen::VectorXd& t) const;
};

/// Each hinge by itself.
HingeTies untied(int hinges);
/// @pre the cells fill a rectangle; a square for rotate_4
HingeTies hinge_ties(const model::Structure& panel, Symmetry symmetry);

}  // namespace kinetix::optim
