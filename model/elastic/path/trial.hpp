#pragma once

#include <optional>

#include "model/elastic/newton.hpp"
#include "model/elastic/path/branch.hpp"

namespace kinetix::model {

/// Final state of a search for the next equilibrium of a path.
struct Trial {
  double theta = 0;  ///< rad
  State state;       ///< in equilibrium if newton.converged
  NewtonResult newton;
  int iterations = 0;  ///< of all searches
  /// Last change of branch: how an unstable equilibrium was left to reach the state, if one was.
  std::optional<Branch::Descent> descent;
  bool mirrored = false;  ///< in equilibrium on the side that was not requested (ClosedForm)
};

}  // namespace kinetix::model
