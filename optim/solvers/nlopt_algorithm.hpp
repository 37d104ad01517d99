#pragma once

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// Returns NLopt's number of a method, an nlopt::algorithm. @pre not ceres, which is not a method of NLopt
int nlopt_algorithm(SolverName name);

}  // namespace kinetix::optim
