#pragma once

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"
#include "optim/solvers/multi_start.hpp"

namespace kinetix::app {

/// Returns the section `optimiser` of a search from many starts. @param chosen index of the run that gave the design
nlohmann::ordered_json search_json(const optim::MultiStartResult& search, int chosen,
                                   optim::SolverName solver);

/// Returns the summary line of a curve's error. @param rms and most: errors over the goal's diagonal
/// @param diagonal_mm of the goal   @param limit of the rms, over the diagonal
SummaryLine describe_shape(double rms, double most, double diagonal_mm, double limit);

/// Returns the section `optimiser` of one search by ceres from `starts` starts.
nlohmann::ordered_json search_json(const optim::SolveResult& search, int starts = 1);
/// Returns the summary line of one search by ceres. @param seconds search time, s
SummaryLine search_line(double seconds, const optim::SolveResult& search);

/// Returns the summary line of a search from many starts. @param seconds search time, s
SummaryLine search_line(double seconds, const optim::MultiStartResult& search, int chosen,
                        optim::SolverName solver);

/// Returns the limit that a goal's `tolerance:` has under a key; NaN if it has none.
double tolerance_of(const Run& run, std::string_view key);

/// Adds `status` and `why` to the section `optimiser`: "stopped", "converged" with `why`, or "failed" with `why_not`.
void add_end(bool stopped, bool found, const std::string& why, const std::string& why_not,
             nlohmann::ordered_json& optimiser);

/// Returns the section `robust` of formats.md. @pre run.robust
nlohmann::ordered_json robust_json(const Run& run);
/// Returns the summary lines of a robust search. Empty without one.
std::vector<SummaryLine> robust_lines(const Run& run);

/// Returns result.json, schema kinetix-result/1 (formats.md, app/schema/result.schema.json). Lengths are in mm, and
/// keys that end in _rad are in radians. Numbers that are not finite become null.
nlohmann::ordered_json result_json(const Run& run);
/// Returns only the section `metrics`.
nlohmann::ordered_json metrics_json(const Run& run);

/// Returns the long form of a run's summary, which `-v` prints. Its first line is that of the short form.
std::string summary(const Run& run);

/// Returns the section `structure`. @param reach_mm reach of hinges without their own value
/// @param elasticity if given, defines the reach of all hinges
nlohmann::ordered_json structure_json(const Design& design, double reach_mm,
                                      const model::Elasticity* elasticity = nullptr);

}  // namespace kinetix::app
