#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace kinetix::optim {

/// min |A u - b|^2 + damping |u - from|^2 where lower <= C u <= upper: a convex problem with a strictly convex
/// cost. Rows of A and C should be of about the same size. All numbers in the unknowns' own units.
struct BoxLeastSquares {
  Eigen::SparseMatrix<double> A;  ///< rows x unknowns, ratios
  Eigen::VectorXd b;              ///< of each row of A, unit of the unknowns
  Eigen::SparseMatrix<double> C;  ///< bounds x unknowns, ratios
  Eigen::VectorXd lower, upper;   ///< lower <= upper, unit of the unknowns
  double damping = 1e-6;          ///< > 0, ratio
  Eigen::VectorXd from;           ///< where damping pulls to, and the search starts; unit of the unknowns
};

struct BoxLeastSquaresOptions {
  /// Of C u, in its unit: how far bounds may be missed, and the change that ends the search.
  double settled = 1e-6;
  int most_iterations = 4000;  ///< >= 1
};

/// What a search knows of its bounds in the end: where one of a problem much like it may start.
struct BoxLeastSquaresMemory {
  Eigen::VectorXd within;  ///< C u within its bounds, in its unit
  Eigen::VectorXd dual;    ///< of each bound, over the penalty
  double penalty = 1;      ///< ratio
};

struct BoxLeastSquaresResult {
  Eigen::VectorXd u;  ///< in its unit
  double excess = 0;  ///< largest miss of a bound, in its unit
  int iterations = 0;
  bool converged = false;
  BoxLeastSquaresMemory memory;
};

/// By alternating directions (Boyd et al. 2011, with the changing penalty of its section 3.4.1): one sparse
/// factor for each penalty, then two solves an iteration.
/// @param memory of a problem with as many bounds; nothing: start anew
/// @throws InvalidInput for sizes that do not fit, lower above upper, or numbers that are not finite
BoxLeastSquaresResult solve_box_least_squares(const BoxLeastSquares& problem,
                                              const BoxLeastSquaresOptions& options = {},
                                              const BoxLeastSquaresMemory* memory = nullptr);

}  // namespace kinetix::optim
