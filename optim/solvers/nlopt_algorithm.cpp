#include "optim/solvers/nlopt_algorithm.hpp"

#include <nlopt.hpp>

namespace kinetix::optim {

int nlopt_algorithm(SolverName name) {
  switch (name) {
    case SolverName::slsqp:
      return nlopt::LD_SLSQP;
    case SolverName::mma:
      return nlopt::LD_MMA;
    case SolverName::ccsa:
      return nlopt::LD_CCSAQ;
    case SolverName::bobyqa:
      return nlopt::LN_BOBYQA;
    case SolverName::cobyla:
      return nlopt::LN_COBYLA;
    default:
      return nlopt::GN_CRS2_LM;
  }
}

}  // namespace kinetix::optim
