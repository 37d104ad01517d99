#pragma once

#include "optim/solvers/arrow_problem.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Solves by Levenberg-Marquardt (Ceres). The parts are eliminated first (Schur complement), so the work is
/// proportional to their number. Ceres' steps stall at active bounds. Variables pressed against their bounds
/// are therefore held there, and the search continues until no others are. The result is the best feasible
/// point evaluated, recorded here and not by Ceres.
/// @param options only max_evaluations and tolerance are used   @throws InvalidInput for invalid options
SolveResult solve(const ArrowProblem& problem, const Eigen::VectorXd& start, const SolverOptions& options);

}  // namespace kinetix::optim
