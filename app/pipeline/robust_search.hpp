#pragma once

#include <functional>

#include "app/run/goal.hpp"
#include "app/run/robust_choice.hpp"

namespace kinetix::app {

/// Values of theta that a robust search tries, in equal steps over its range, each in a range as narrow as one may be, rad.
inline constexpr int robust_thetas = 9;
inline constexpr double narrow_theta = 1e-3;

/// Whether hinges are blocks or films, which have gaps.
bool has_gap(const HingeSection& hinge);

/// A candidate of which nothing is known but its theta, rad, its cells and its hinges.
RobustCandidate not_judged(double theta, double cell_mm, const HingeSection& hinge);

/// What a robust search may try.
struct RobustTrial {
  std::optional<optim::AngleRange> theta;  ///< rad, as narrow as searches take it; nothing: that of the file
  HingeSection hinge;                      ///< with another gap of its blocks or films
};

using RobustSolve = std::function<Found(const RobustTrial&, const RunOptions&)>;

/// Judges a design that was found as the pipeline would leave it, without a physics run.
RobustCandidate robust_candidate(Found found, const Goal& goal, const RunOptions& options);

/// Of the plain design and others, at nine values of theta and three gaps of hinges, keeps the one with the least
/// robust_cost(), prints to first order, among those that meet the goal once they have made up for elastic hinges and that
/// their hinges bear: returns that one, and says in `robust` what was tried.
/// One without an expectation, or further off than the goal allows, is not taken unless the plain one is as well.
/// @param plain what the plain search found   @param weight of prints, (0, 1]   @param theta what may be tried of it, rad; nothing: theta is given
/// @param solve a trial; one that throws InvalidInput cannot be made
Found search_robustly(Found plain, const Goal& goal, double weight,
                      const std::optional<optim::AngleRange>& theta, const RobustSolve& solve,
                      const RunOptions& options);

/// How many designs it tries, likewise.
int designs_of_robust_search(const std::optional<optim::AngleRange>& theta, const HingeSection& hinge);

}  // namespace kinetix::app
