#include "app/result/search_json.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

std::string words(const RobustCandidate& one) {
  std::string text = fmt::format("theta {:.1f} deg", one.theta / radians_per_degree);
  if (one.gap_mm) text += fmt::format(" and gaps of {:.2g} mm", *one.gap_mm);
  return text + (std::isfinite(one.as_made_mm) ? fmt::format(", {:.3g} mm", one.as_made_mm) : ", not known") +
         (one.is_allowed ? "" : " (not to be taken: " + one.why_not + ")");
}

}  // namespace

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

Json robust_json(const Run& run) {
  Json out = Json::array();
  for (std::size_t k = 0; k < run.robust->tried.size(); ++k) {
    const RobustCandidate& one = run.robust->tried[k];
    out.push_back({{"theta_rad", one.theta},
                   {"cell_mm", one.cell_mm},
                   {"gap_mm", one.gap_mm ? Json(*one.gap_mm) : Json(nullptr)},
                   {"designed_mm", one.designed_mm},
                   {"as_made_rms_mm", one.as_made_mm},
                   {"as_made_p95_mm", one.as_made_p95},
                   {"allowed", one.is_allowed},
                   {"chosen", k == run.robust->chosen}});
    if (!one.is_allowed) out.back()["why_not"] = one.why_not;
  }
  return out;
}

std::vector<SummaryLine> robust_lines(const Run& run) {
  if (!run.robust) return {};
  const RobustCandidate &best = run.robust->tried[run.robust->chosen], &plain = run.robust->tried.front();
  if (run.robust->chosen == 0)
    return {
        {"robust",
         fmt::format("of {} designs tried, prints of none that may be taken come nearer than those of the "
                     "plain search's{}",
                     run.robust->tried.size(), plain.is_allowed ? "" : ", " + words(plain))}};
  return {
      {"robust",
       fmt::format("of {} designs tried, that whose prints are expected nearest: {}; the plain search's: {}",
                   run.robust->tried.size(), words(best), words(plain))}};
}

}  // namespace kinetix::app
