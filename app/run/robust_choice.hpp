#pragma once

#include <optional>
#include <string>
#include <vector>

namespace kinetix::app {

/// What a robust search makes small, mm. @param weight of prints, (0, 1]; the rest to 1 is that of the design itself
inline double robust_cost(double weight, double designed_mm, double as_made_mm) {
  return (1 - weight) * designed_mm + weight * as_made_mm;
}

/// Whether a search takes a candidate (designed_mm, as_made_mm, is_allowed) instead of the best so far.
template <class Candidate>
bool is_more_robust(double weight, const Candidate& next, const Candidate& best) {
  const auto cost = [&](const Candidate& c) { return robust_cost(weight, c.designed_mm, c.as_made_mm); };
  return next.is_allowed && (!best.is_allowed || cost(next) < cost(best));
}

/// A design that was tried for how its prints come out.
struct RobustCandidate {
  double theta = 0;  ///< rad
  double cell_mm = 0;
  std::optional<double> gap_mm = {};  ///< of blocks and films
  double designed_mm = 0;             ///< rms that the design itself is off; NaN where that is not known
  double as_made_mm = 0;              ///< rms that prints are expected to be off; NaN likewise
  double as_made_p95 = 0;             ///< mm, what 95 of 100 keep; NaN likewise
  /// It meets the goal, in the equilibrium of its hinges as well, it can be printed, and its hinges bear it.
  bool is_allowed = false;
  std::string why_not = {};  ///< in words, where it is not allowed
};

/// Designs from which a robust search chose.
struct RobustChoice {
  std::vector<RobustCandidate> tried;  ///< first the plain search's
  std::size_t chosen = 0;              ///< in tried
};

}  // namespace kinetix::app
