#pragma once

#include <vector>

#include "model/lattice/square/structure.hpp"
#include "optim/solvers/variables.hpp"

namespace kinetix::optim {

/// Hinges of a rectangular panel that share a variable for t, which gives the flat panel the symmetry of a
/// motion of the plane. Hinge h has t = x[variable[h]], or 1 - x[variable[h]] if the motion turns its wall
/// end to end. A wall that it maps onto itself keeps t = 0.5: `centred`.
struct HingeTies {
  static constexpr int centred = -1;  ///< in place of an index: the hinge has no variable
  std::vector<int> variable;
  std::vector<bool> reversed;
  int variables = 0;

  Eigen::VectorXd expand(const Eigen::VectorXd& x) const;
  /// Returns the gradient by x of a function with the given gradient by t of all hinges.
  Eigen::VectorXd gather(const Eigen::VectorXd& by_t) const;
  /// Returns t with every hinge on the same side of the middle as the first hinge of its variable; other
  /// hinges get 1 - t. On panels with an odd number of cells per side a motion swaps the sublattices. The
  /// picture's demands on both would then cancel.
  Eigen::VectorXd to_one_side(Eigen::VectorXd t) const;
  /// Returns the x for which expand() is nearest to t, least squares.
  Eigen::VectorXd nearest(const Eigen::VectorXd& t) const;
};

/// Returns ties with a separate variable for each hinge.
HingeTies untied(int hinges);
/// Returns the ties of a symmetry. @pre the cells fill a rectangle; a square for rotate_4
HingeTies hinge_ties(const model::Structure& panel, Symmetry symmetry);

}  // namespace kinetix::optim
