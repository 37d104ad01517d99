#include "app/goals/curve/curve_outcome.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/result/state_json.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(const targets::CurveError& error) {
  Json out = Json::array();
  for (std::size_t k = 0; k < error.arc_mm.size(); ++k)
    out.push_back({error.arc_mm[k], error.distance_mm[k]});
  return out;
}

Json turns_json(const optim::CurveReach& reach) {
  Json out = Json::array();
  for (const optim::ColumnTurn& t : reach.turns)
    out.push_back({{"column", t.column},
                   {"arc_mm", t.arc_mm},
                   {"needed_deg", t.needed / radians_per_degree},
                   {"allowed_deg", std::abs(t.allowed) / radians_per_degree}});
  return out;
}

Json curve_json(const CurveOutcome& curve) {
  const optim::CurveDesign& found = curve.found.design;
  return {{"folded_mm", points_json(found.midline_mm)},
          {"goal_mm", points_json(found.error.goal_mm)},
          {"error", error_json(found.error)},
          {"scale_mm", found.error.scale_mm},
          {"turn", turns_json(found.reach)},
          {"reasons", curve.violations}};
}

Json optimiser_json(const CurveOutcome& curve) {
  const optim::CurveDesign& found = curve.found.design;
  Json runs = Json::array();
  int evaluations = 0;
  for (std::size_t k = 0; k < found.search.runs.size(); ++k) {
    const optim::SolveResult& run = found.search.runs[k];
    evaluations += run.evaluations;
    runs.push_back({{"start", k},
                    {"status", to_string(run.status)},
                    {"fit_rms", run.residual_norm},
                    {"evaluations", run.evaluations},
                    {"history", run.history}});
  }
  const optim::SolveResult& best = found.search.runs[found.chosen];
  return {{"solver", to_string(curve.solver.name)},
          {"starts", runs.size()},
          {"evaluations", evaluations},
          {"status", to_string(best.status)},
          {"why", best.why},
          {"best_start", found.chosen},
          {"runs", runs}};
}

std::string verdict(const CurveOutcome& curve) {
  if (curve.met()) return "within tolerance";
  const bool close = curve.found.design.error.rms <= curve.shape_tolerance;
  return close ? "WITHIN TOLERANCE, BUT WALLS COLLIDE" : "MISSES THE TOLERANCE";
}

}  // namespace

Json CurveOutcome::target_json() const { return {{"kind", "curve"}, {"points_mm", points_json(target_mm)}}; }

void CurveOutcome::add_sections(const Run&, Json& result) const {
  result["curve"] = curve_json(*this);
  result["optimiser"] = optimiser_json(*this);
}

void CurveOutcome::add_metrics(Json& metrics) const {
  metrics["shape_rms"] = found.design.error.rms;
  metrics["shape_max"] = found.design.error.max;
  metrics["met"] = met();
}

std::vector<SummaryLine> CurveOutcome::summary_lines(const Run& run) const {
  const targets::CurveError& error = found.design.error;
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"shape", fmt::format("rms {:.2e} of the goal's diagonal ({:.3f} mm), largest {:.3f} mm: {}", error.rms,
                            error.rms * error.scale_mm, error.max * error.scale_mm, verdict(*this))});
  for (const std::string& why : violations) lines.push_back({"why", why});
  const optim::SolveResult& best = found.design.search.runs[found.design.chosen];
  lines.push_back(
      {"search", fmt::format("{:.3f} s, {} from {} starts, {}", run.timings.optimise, to_string(solver.name),
                             found.design.search.runs.size(), to_string(best.status))});
  return lines;
}

}  // namespace kinetix::app
