#pragma once

#include <optional>

#include "model/elastic/branch.hpp"
#include "model/elastic/newton.hpp"

namespace kinetix::model {

/// The state that a search for the next equilibrium of a path ended in.
struct Trial {
  double theta = 0;  ///< rad
  State state;       ///< in equilibrium if newton.converged
  NewtonResult newton;
  int iterations = 0;  ///< of all of its searches
  /// How an unstable equilibrium on the way was left, if one was: the last turn from one branch to another.
  std::optional<Branch::Descent> descent;
};

}  // namespace kinetix::model
