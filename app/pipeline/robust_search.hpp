#pragma once

#include "app/run/goal.hpp"
#include "app/run/search_result.hpp"

namespace kinetix::app {

/// Number of thetas that a robust search tries, in equal steps over its range. Each is searched in the narrowest
/// range allowed, rad.
inline constexpr int robust_thetas = 9;
inline constexpr double narrow_theta = 1e-3;

/// Whether hinges are blocks or films, which have gaps.
bool has_gap(const HingeSection& hinge);

/// Returns a candidate with nothing known but its theta, rad, its cell size and the gap of its hinges.
RobustCandidate unevaluated_candidate(double theta, double cell_mm, const HingeSection& hinge);

/// Variation that a robust search tries.
struct RobustTrial {
  std::optional<optim::AngleRange> theta;  ///< rad, as narrow as searches allow; empty: the file's
  HingeSection hinge;                      ///< with the gap of its blocks or films varied
};

using RobustSolve = std::function<SearchResult(const RobustTrial&, const RunOptions&)>;

/// Gives open joints the hinges that `export` would print; the search stays as it is if it would print none.
SearchResult with_printed_hinges(SearchResult found, const RunOptions& options);

/// Evaluates a design that was found as the pipeline would, without a simulation.
RobustCandidate robust_candidate(SearchResult found, const Goal& goal, const RunOptions& options);

/// Searches for the design with the least robust_cost(), with prints taken to first order. Tries the plain design,
/// and others at nine values of theta and three gaps of hinges. A candidate must meet the goal after compensation for
/// elastic hinges, and its hinges must withstand the strain. It also needs a known print error, and the design itself
/// must be within the tolerance. Returns the best candidate, or the plain design if none qualifies. Its `robust`
/// lists the trials.
/// @param plain result of the plain search.   @param weight of prints, (0, 1].
/// @param theta range to try, rad; empty: theta is given.
/// @param solve solves a trial; throws InvalidInput if that design cannot be made
SearchResult search_robustly(SearchResult plain, const Goal& goal, double weight,
                             const std::optional<optim::AngleRange>& theta, const RobustSolve& solve,
                             const RunOptions& options);

/// Returns how many designs the robust search tries.
int designs_of_robust_search(const std::optional<optim::AngleRange>& theta, const HingeSection& hinge);

}  // namespace kinetix::app
