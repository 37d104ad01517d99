#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"
#include "optim/solvers/multi_start.hpp"

namespace kinetix::app {

/// The `optimiser` of a search from many starts. @param chosen index of the run that the design comes from
nlohmann::ordered_json search_json(const optim::MultiStartResult& search, int chosen,
                                   optim::SolverName solver);

/// The `optimiser` of one search by ceres from `starts` starts.
nlohmann::ordered_json search_json(const optim::SolveResult& search, int starts = 1);
SummaryLine search_line(double seconds, const optim::SolveResult& search);

/// The line of the summary for such a search. @param seconds that it took
SummaryLine search_line(double seconds, const optim::MultiStartResult& search, int chosen,
                        optim::SolverName solver);

/// Adds to such an `optimiser` how a search ended that ends by itself: "stopped" where it was, else "converged" with `why` or
/// "failed" with `why_not`.
void add_end(bool stopped, bool found, const std::string& why, const std::string& why_not,
             nlohmann::ordered_json& optimiser);

/// The section `robust` of formats.md. @pre run.robust
nlohmann::ordered_json robust_json(const Run& run);
/// Lines of the summary; none without a robust search.
std::vector<SummaryLine> robust_lines(const Run& run);

}  // namespace kinetix::app
