#include <fmt/format.h>

#include "app/console/short_form.hpp"
#include "app/goals/fold/fold_goal.hpp"
#include "app/result/result_json.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json loads_json(const FoldLoads& loads) {
  return {{"theta_rad", loads.theta}, {"force_N", loads.hinges.force_N}, {"strain", loads.hinges.strain}};
}

std::string loads_text(const FoldLoads& loads) {
  return fmt::format("at a fold angle of {:.1f} deg: {:.3g} N{}, strain {:.2f}", to_degrees(loads.theta),
                     loads.hinges.force_N, describe_lever(loads.hinges), loads.hinges.strain);
}

/// Lists the faces of the ideal solid, aligned with the folded state, as closed lines.
Json ideal_json(const FoldShape& shape, const model::State& state) {
  std::map<int, Eigen::Vector3d> places;
  for (const targets::IdealPoint& one : shape.ideal(shape.sheet, state)) places[one.body] = one.place;
  Json out = Json::array();
  for (const std::vector<int>& outline : shape.outlines) {
    Json line = Json::array();
    for (const int body : outline) {
      const Eigen::Vector3d& p = places.at(body);
      line.push_back({p.x(), p.y(), p.z()});
    }
    out.push_back(std::move(line));
  }
  return out;
}

/// Adds fold_deg, fold_miss_deg and face_rms. @param state "", or "_physics" for the simulation
void add_fold_metrics(const FoldShape& shape, const targets::FoldError& error, const std::string& state,
                      Json& metrics) {
  Json& folds = metrics["fold" + state + "_deg"] = Json::array();
  for (const double fold : error.fold) folds.push_back(to_degrees(fold));
  metrics["fold_miss" + state + "_deg"] = to_degrees(shape.largest_miss(error));
  metrics["face_rms" + state] = error.rms;
}

}  // namespace

void FoldOutcome::add_sections(const Run& run, Json& result) const {
  const auto& shown = measure_of<FoldMeasure>(run);
  const auto* physics = physics_measure_of<FoldMeasure>(run);
  result["target"] = shape.target;
  Json out = {{"faces", shape.faces}, {"creases", Json::array()}};
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    out["faces"][f]["rms"] = shown.error.face_rms[f];
    if (physics) out["faces"][f]["rms_physics"] = physics->error.face_rms[f];
  }
  for (std::size_t c = 0; c < shape.creases.size(); ++c) {
    Json crease = shape.creases[c].section;
    crease["angle_deg"] = to_degrees(shape.creases[c].angle);
    crease["fold_deg"] = to_degrees(shown.error.fold[c]);
    crease["tilt_deg"] = to_degrees(shown.tilt[c]);
    if (physics) crease["fold_physics_deg"] = to_degrees(physics->error.fold[c]);
    out["creases"].push_back(std::move(crease));
  }
  out["unfoldings"] = shape.unfoldings;
  out["unfolding"] = shape.unfolding;
  out["attempts"] = Json::array();
  for (const optim::FoldAttempt& attempt : shape.attempts)
    out["attempts"].push_back(
        {{"unfolding", attempt.net}, {"columns", attempt.columns}, {"why", attempt.why}});
  out["reasons"] = run.violations;
  out["reasons_physics"] = run.physics_violations();
  if (shape.edges_mm) out["edges_mm"] = *shape.edges_mm;
  if (shown.loads) out["loads"] = loads_json(*shown.loads);
  if (unlimited) out["unlimited"] = loads_json(*unlimited);
  if (shape.folds && !run.states.empty() && is_finite(run.states.front().poses))
    out["ideal_mm"] = ideal_json(shape, run.states.front().poses);
  result["fold"] = std::move(out);
  result["optimiser"] = {
      {"solver", "closed form"}, {"starts", shape.attempts.size()}, {"evaluations", shape.evaluations}};
  add_end(shape.stopped, shape.folds,
          "every crease reaches its angle at one fold angle, and no walls collide", shape.why_not,
          result["optimiser"]);
}

void FoldOutcome::add_metrics(const Run& run, Json& metrics) const {
  add_fold_metrics(shape, measure_of<FoldMeasure>(run).error, "", metrics);
  metrics["met"] = run.met();
  if (const auto* physics = physics_measure_of<FoldMeasure>(run))
    add_fold_metrics(shape, physics->error, "_physics", metrics);
}

std::vector<SummaryLine> FoldOutcome::summary_lines(const Run& run) const {
  const auto& shown = measure_of<FoldMeasure>(run);
  std::vector<SummaryLine> lines = {
      {"solid", shape.describe(shown.error, FoldShape::Limits{tolerance_of(run, "angle_deg"),
                                                              tolerance_of(run, "shape")})}};
  lines.insert(lines.end(), shape.lines.begin(), shape.lines.end());
  lines.push_back(
      {"search", fmt::format("{:.2g} s, {} motions examined", run.timings.optimise, shape.evaluations)});
  if (shown.loads) lines.push_back({"limits", loads_text(*shown.loads)});
  if (unlimited) lines.push_back({"", "without limits " + loads_text(*unlimited)});
  if (const auto* physics = physics_measure_of<FoldMeasure>(run))
    lines.push_back({"check", "in the simulation: " + shape.describe(physics->error)});
  return lines;
}

}  // namespace kinetix::app
