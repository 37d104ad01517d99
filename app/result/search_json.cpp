#include "app/result/search_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kinetix::app {

nlohmann::ordered_json search_json(const optim::MultiStartResult& search, int chosen,
                                   optim::SolverName solver) {
  auto runs = nlohmann::ordered_json::array();
  int evaluations = 0;
  for (std::size_t k = 0; k < search.runs.size(); ++k) {
    const optim::SolveResult& run = search.runs[k];
    evaluations += run.evaluations;
    runs.push_back({{"start", k},
                    {"status", to_string(run.status)},
                    {"fit_rms", run.residual_norm},
                    {"evaluations", run.evaluations},
                    {"history", run.history}});
  }
  const optim::SolveResult& best = search.runs[chosen];
  return {{"solver", to_string(solver)},
          {"starts", runs.size()},
          {"evaluations", evaluations},
          {"status", to_string(best.status)},
          {"why", best.why},
          {"best_start", chosen},
          {"runs", runs}};
}

SummaryLine search_line(double seconds, const optim::MultiStartResult& search, int chosen,
                        optim::SolverName solver) {
  return {"search", fmt::format("{:.3f} s, {} from {} starts, {}", seconds, to_string(solver),
                                search.runs.size(), to_string(search.runs[chosen].status))};
}

nlohmann::ordered_json search_json(const optim::SolveResult& search, int starts) {
  return {{"solver", "ceres"},
          {"starts", starts},
          {"evaluations", search.evaluations},
          {"status", to_string(search.status)},
          {"why", search.why}};
}

SummaryLine search_line(double seconds, const optim::SolveResult& search) {
  return {"search", fmt::format("{:.2f} s, ceres, {} evaluations, {}", seconds, search.evaluations,
                                to_string(search.status))};
}

void add_end(bool stopped, bool found, const std::string& why, const std::string& why_not,
             nlohmann::ordered_json& optimiser) {
  const char* const ended = found ? "converged" : "failed";
  optimiser["status"] = stopped ? "stopped" : ended;
  optimiser["why"] = stopped ? "stopped" : found ? why : why_not;
}

}  // namespace kinetix::app
