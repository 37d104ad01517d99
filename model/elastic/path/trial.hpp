#pragma once

#include <optional>

#include "model/elastic/newton.hpp"
#include "model/elastic/path/branch.hpp"

namespace kinetix::model {

/// The state that a search for the next equilibrium of a path ended in.
struct Trial {
  double theta = 0;  ///< rad
  State state;       ///< in equilibrium if newton.converged
  NewtonResult newton;
  int iterations = 0;  ///< of all of its searches
  /// How an unstable equilibrium was left to get there, if one was: the last change of branch.
  std::optional<Branch::Descent> descent;
  bool mirrored = false;  ///< it is in equilibrium on the side that was not asked for (ClosedForm)
};

}  // namespace kinetix::model
