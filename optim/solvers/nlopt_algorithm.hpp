#pragma once

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {

/// NLopt's number of a method, an nlopt::algorithm. @pre not ceres, which is none of NLopt's
int nlopt_algorithm(SolverName name);

}  // namespace kinetix::optim
