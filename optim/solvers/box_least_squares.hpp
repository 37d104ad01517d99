#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace kinetix::optim {

/// Convex problem: min |A u - b|^2 + damping |u - from|^2 subject to lower <= C u <= upper. The cost is
/// strictly convex. Rows of A and C should be of about the same size. All numbers in the unknowns' own units.
struct BoxLeastSquares {
  Eigen::SparseMatrix<double> A;  ///< rows x unknowns, ratios
  Eigen::VectorXd b;              ///< of each row of A, unit of the unknowns
  Eigen::SparseMatrix<double> C;  ///< bounds x unknowns, ratios
  Eigen::VectorXd lower, upper;   ///< lower <= upper, unit of the unknowns
  double damping = 1e-6;          ///< > 0, ratio
  Eigen::VectorXd from;           ///< start of the search and centre of the damping; unit of the unknowns
};

struct BoxLeastSquaresOptions {
  /// Largest allowed miss of a bound, and largest change of C u at the end, in its unit.
  double settled = 1e-6;
  int most_iterations = 4000;  ///< >= 1
};

/// Final state of a search, from which a search of a similar problem can start.
struct BoxLeastSquaresMemory {
  Eigen::VectorXd within;  ///< C u clamped to its bounds, in its unit
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

/// Solves by alternating directions (Boyd et al. 2011, with the changing penalty of its section 3.4.1). It
/// needs one sparse factor per penalty, and one solve per iteration.
/// @param memory of a problem with as many bounds; null: start anew
/// @throws InvalidInput for sizes that do not fit, lower above upper, or numbers that are not finite
BoxLeastSquaresResult solve_box_least_squares(const BoxLeastSquares& problem,
                                              const BoxLeastSquaresOptions& options = {},
                                              const BoxLeastSquaresMemory* memory = nullptr);

}  // namespace kinetix::optim
