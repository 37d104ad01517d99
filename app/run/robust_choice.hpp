#pragma once

#include <optional>
#include <string>
#include <vector>

namespace kinetix::app {

/// Returns the cost that a robust search minimises, mm. @param weight of prints, (0, 1]; the design itself has the
/// rest to 1
inline double robust_cost(double weight, double designed_mm, double as_made_mm) {
  return (1 - weight) * designed_mm + weight * as_made_mm;
}

/// Whether a search prefers a candidate (designed_mm, as_made_mm, is_allowed) to the best so far.
template <class Candidate>
bool is_more_robust(double weight, const Candidate& next, const Candidate& best) {
  const auto cost = [&](const Candidate& c) { return robust_cost(weight, c.designed_mm, c.as_made_mm); };
  return next.is_allowed && (!best.is_allowed || cost(next) < cost(best));
}

/// Design tried by a robust search, with the expected error of its prints.
struct RobustCandidate {
  double theta = 0;  ///< rad
  double cell_mm = 0;
  std::optional<double> gap_mm = {};  ///< of blocks and films
  double designed_mm = 0;             ///< rms error of the design itself; NaN if not known
  double as_made_mm = 0;              ///< expected rms error of prints; NaN if not known
  double as_made_p95 = 0;             ///< mm, error that 95 of 100 prints stay within; NaN if not known

  /// Whether it meets the goal, also in the equilibrium of its hinges, can be printed, and its hinges withstand the
  /// strain.
  bool is_allowed = false;
  std::string why_not = {};  ///< reason in words if it is not allowed
};

/// Designs from which a robust search chose.
struct RobustChoice {
  std::vector<RobustCandidate> tried;  ///< the plain search's design first
  std::size_t chosen = 0;              ///< index in tried
};

}  // namespace kinetix::app
