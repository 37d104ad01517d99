#include "app/goals/curve/curve_outcome.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/result/search_json.hpp"
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

Json robust_json(const RobustCurve& robust) {
  Json out = Json::array();
  for (std::size_t k = 0; k < robust.tried.size(); ++k) {
    const CurveCandidate& one = robust.tried[k];
    out.push_back({{"columns", one.columns},
                   {"cell_mm", one.cell_mm},
                   {"gap_mm", one.gap_mm ? Json(*one.gap_mm) : Json(nullptr)},
                   {"theta_rad", one.theta},
                   {"shape_rms", one.shape_rms},
                   {"as_made_rms_mm", one.as_made_mm},
                   {"as_made_p95_mm", one.as_made_p95},
                   {"allowed", one.is_allowed},
                   {"in_matter", one.in_matter},
                   {"chosen", k == robust.chosen}});
  }
  return out;
}

Json curve_json(const CurveOutcome& curve, const Run& run) {
  const auto& shape = measure_of<CurveMeasure>(run);
  return {{"folded_mm", points_json(shape.midline_mm)},
          {"goal_mm", points_json(shape.error.goal_mm)},
          {"error", error_json(shape.error)},
          {"scale_mm", shape.error.scale_mm},
          {"turn", turns_json(curve.found.design.reach)},
          {"reasons", run.violations}};
}

std::string robust_text(const RobustCurve& robust) {
  const CurveCandidate &best = robust.tried[robust.chosen], &plain = robust.tried.front();
  if (robust.chosen == 0)
    return fmt::format(
        "of {} strips tried, prints of none that may be taken come nearer than those of the plain search's",
        robust.tried.size());
  const std::string gaps = best.gap_mm ? fmt::format(", gaps of {:.2g} mm", *best.gap_mm) : "";
  return fmt::format(
      "{} columns at theta {:.1f} deg{}, of {} strips tried: prints{} are expected {:.3g} mm off; of the "
      "design with the least error of its own, {} columns at {:.1f} deg, {}",
      best.columns, best.theta / radians_per_degree, gaps, robust.tried.size(),
      best.in_matter ? "" : " of its closed form", best.as_made_mm, plain.columns,
      plain.theta / radians_per_degree,
      std::isfinite(plain.as_made_mm) ? fmt::format("{:.3g} mm", plain.as_made_mm) : "that is not known");
}

std::string tolerance_words_of(const CurveOutcome& curve, const Run& run) {
  const bool close = measure_of<CurveMeasure>(run).error.rms <= curve.shape_tolerance;
  if (run.met() || run.strained || !close) return tolerance_words(run, close);
  return curve.found.walls_are_free ? "WITHIN TOLERANCE, BUT DOES NOT HOLD"
                                    : "WITHIN TOLERANCE, BUT WALLS COLLIDE";
}

}  // namespace

void CurveOutcome::add_sections(const Run& run, Json& result) const {
  result["target"] = {{"kind", "curve"}, {"points_mm", points_json(target_mm)}};
  result["curve"] = curve_json(*this, run);
  if (robust) result["curve"]["robust"] = robust_json(*robust);
  result["optimiser"] = search_json(found.design.search, found.design.chosen, solver.name);
}

void CurveOutcome::add_metrics(const Run& run, Json& metrics) const {
  const targets::CurveError& error = measure_of<CurveMeasure>(run).error;
  metrics["shape_rms"] = error.rms;
  metrics["shape_max"] = error.max;
  metrics["met"] = run.met();
}

std::vector<SummaryLine> CurveOutcome::summary_lines(const Run& run) const {
  const targets::CurveError& error = measure_of<CurveMeasure>(run).error;
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"shape",
       fmt::format("rms {:.2e} of the goal's diagonal ({:.3f} mm from curve to curve), largest {:.3f} mm: {}",
                   error.rms, error.rms * error.scale_mm, error.max * error.scale_mm,
                   tolerance_words_of(*this, run))});
  if (robust) lines.push_back({"robust", robust_text(*robust)});
  lines.push_back(search_line(run.timings.optimise, found.design.search, found.design.chosen, solver.name));
  return lines;
}

}  // namespace kinetix::app
