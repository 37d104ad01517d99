#pragma once

#include "optim/solvers/arrow_problem.hpp"
#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Levenberg-Marquardt (Ceres), the parts eliminated first (Schur complement): the work grows in proportion
/// to the parts. Ceres' steps stick where a bound is pressed on, so variables that press on theirs are held
/// there and the search goes on from where it was, until no other do. The best feasible point evaluated is
/// returned, by our own book.
/// @param options max_evaluations and tolerance count; @throws InvalidInput where they do not validate
SolveResult solve(const ArrowProblem& problem, const Eigen::VectorXd& start, const SolverOptions& options);

}  // namespace kinetix::optim
