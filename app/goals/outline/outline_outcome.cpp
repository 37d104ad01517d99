#include "app/goals/outline/outline_outcome.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/pictures/panel_picture.hpp"
#include "app/result/search_json.hpp"
#include "app/result/state_json.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(const targets::OutlineError& error) {
  return {{"rms", error.rms}, {"max", error.max}, {"iou", error.iou}};
}

/// Which bound holds the rim back, for a panel that misses.
std::string what_binds(const optim::OutlineDesign& design) {
  return fmt::format("{:.0f} % of the walls have the largest offset, {:.0f} % turn as far as they may",
                     100 * design.at_bounds_offset, 100 * design.at_bounds_shift);
}

/// Of a panel whose walls do not meet.
std::string ended_words(const optim::OutlineDesign& design) {
  const std::string moves = design.settled
                                ? "no vertex moves any more"
                                : "it took as many rounds as it may, and vertices still move a little";
  return moves + ", and no walls meet on the way";
}

std::string size_words(double size) {
  if (std::abs(size - 1) < 5e-3) return "as large as drawn";
  return fmt::format("{:.3g} times as large as drawn", size);
}

}  // namespace

std::vector<Eigen::Vector2d> OutlineOutcome::placed(double edge_mm) const {
  std::vector<Eigen::Vector2d> out;
  for (const Eigen::Vector2d& p : file.folded.points())
    out.push_back(edge_mm * (p / design.scale + design.origin));
  return out;
}

void OutlineOutcome::add_sections(const Run& run, Json& result) const {
  Json target = {{"kind", "outline"}, {"points_mm", points_json(file.folded.points())}};
  if (file.flat) target["flat_mm"] = points_json(file.flat->points());
  result["target"] = target;
  const double edge = run.design.structure.size().edge_mm;
  Json section = {{"goal_mm", points_json(placed(edge))},
                  {"rim", rim},
                  {"size", size(edge)},
                  {"lattice_deg", -to_degrees(turn)},
                  {"diagonal_mm", size(edge) * file.folded.diagonal()},
                  {"exact", error_json(design.error)},
                  {"offset_mm", design.offset * edge},
                  {"turn", design.shift},
                  {"at_bounds", {{"offset", design.at_bounds_offset}, {"turn", design.at_bounds_shift}}},
                  {"walls_meet", !design.clear},
                  {"cuts", cuts},
                  {"reasons", run.violations},
                  {"reasons_physics", run.physics_violations()}};
  if (file.flat) section["flat"] = error_json(design.flat);
  if (run.by_equilibrium) section["equilibrium"] = error_json(measure_of<OutlineMeasure>(run).error);
  if (const auto* physics = physics_measure_of<OutlineMeasure>(run))
    section["physics"] = error_json(physics->error);
  result["outline"] = section;
  result["optimiser"] = {
      {"solver", "alternating directions"}, {"starts", std::max(1, cuts)}, {"evaluations", design.rounds}};
  add_end(
      design.stopped, design.clear, ended_words(design),
      fmt::format("walls still meet on the way after {} rounds, from each to the next with less turning of "
                  "those that did",
                  design.clearance_rounds),
      result["optimiser"]);
  if (design.clear && !design.settled && !design.stopped)
    result["optimiser"]["status"] = to_string(optim::SolveStatus::evaluation_limit);
}

void OutlineOutcome::add_metrics(const Run& run, Json& metrics) const {
  const targets::OutlineError& error = measure_of<OutlineMeasure>(run).error;
  metrics["outline_rms"] = error.rms;
  metrics["outline_max"] = error.max;
  metrics["iou"] = error.iou;
  if (file.flat) {
    metrics["flat_rms"] = design.flat.rms;
    metrics["flat_iou"] = design.flat.iou;
  }
  if (const auto* physics = physics_measure_of<OutlineMeasure>(run)) {
    metrics["outline_rms_physics"] = physics->error.rms;
    metrics["iou_physics"] = physics->error.iou;
  }
  metrics["met"] = run.met();
}

std::vector<SummaryLine> OutlineOutcome::summary_lines(const Run& run) const {
  const double edge = run.design.structure.size().edge_mm;
  const targets::OutlineError& error = measure_of<OutlineMeasure>(run).error;
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"outline",
       fmt::format("rim {:.2f} % of the diagonal off the outline (rms, {:.3f} mm), area {:.1f} % "
                   "shared, {}: {}",
                   100 * error.rms, error.rms * size(edge) * file.folded.diagonal(), 100 * error.iou,
                   size_words(size(edge)), tolerance_words(run, app::violations(file, error, "").empty()))});
  if (file.flat)
    lines.push_back(
        {"flat", fmt::format("rim {:.2f} % of the diagonal off its outline (rms), area {:.1f} % shared",
                             100 * design.flat.rms, 100 * design.flat.iou)});
  if (!run.met()) lines.push_back({"bounds", what_binds(design)});
  lines.push_back(
      {"hinges", fmt::format("up to {:.2f} mm off the middle of their walls, t from {:.2f} to {:.2f}",
                             design.offset * edge, 0.5 - design.shift / 2, 0.5 + design.shift / 2)});
  lines.push_back(
      {"search", fmt::format("{:.2f} s, {} convex problems{}", run.timings.optimise, design.rounds,
                             cuts > 0 ? fmt::format(", {} cuts of the lattice", cuts) : "")});
  return lines;
}

std::vector<NamedContent> OutlineOutcome::pictures(const Run& run, bool of_report) const {
  if (of_report) return {};
  std::vector<NamedContent> files;
  const model::State flat = rest_state(run.design.structure);
  for (const auto& [name, state] :
       {std::pair("flat", &flat), std::pair("pressed", &run.states.front().poses)})
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png})
      files.push_back({std::string(name) + (format == PictureFormat::svg ? ".svg" : ".png"),
                       panel_picture(run.design.structure, *state, {.format = format})});
  return files;
}

std::vector<std::string> violations(const OutlineFile& file, const targets::OutlineError& error,
                                    const std::string& who) {
  std::vector<std::string> why;
  if (!(error.rms <= file.shape_tolerance))
    why.push_back(
        fmt::format("{}: the rim is {:.2f} % of the diagonal off the outline; at most {:.2f} % is allowed",
                    who, 100 * error.rms, 100 * file.shape_tolerance));
  if (!(error.iou >= file.iou_tolerance))
    why.push_back(fmt::format("{}: {:.1f} % of the area is shared; at least {:.1f} % is asked", who,
                              100 * error.iou, 100 * file.iou_tolerance));
  return why;
}

}  // namespace kinetix::app
