#include "app/goals/display/display_outcome.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/result/result_json.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the mean transmittance of letter and rest; nullopt for grey pictures.
std::optional<std::array<double, 2>> light_of(const DisplayOutcome& display, const DisplayReading& reading) {
  if (display.channel != optim::Channel::light || !display.goal.is_binary()) return reading.light;
  return std::array{reading.score.letter, reading.score.rest};
}

Json score_json(const DisplayOutcome& display, const DisplayReading& reading) {
  Json out = {{"auc", reading.score.auc},       {"contrast", reading.score.contrast},
              {"letter", reading.score.letter}, {"rest", reading.score.rest},
              {"rank", reading.rank},           {"cells", reading.channel}};
  if (const auto light = light_of(display, reading))
    out["light"] = {{"letter", (*light)[0]}, {"rest", (*light)[1]}};
  if (reading.seen) out["seen"] = {{"parts", reading.seen->components}, {"holes", reading.seen->holes}};
  return out;
}

/// Describes the mean light of letter and rest; empty for pictures in greys.
std::string describe_light(const DisplayOutcome& display, const DisplayReading& r) {
  const auto light = light_of(display, r);
  if (!light) return "";
  return fmt::format("{:.3g} % light in letter, {:.3g} % elsewhere; ", 100 * (*light)[0], 100 * (*light)[1]);
}

/// Describes the reading with the limits of the goal.
std::string describe_with_limits(const DisplayOutcome& display, const DisplayReading& r, const Run& run) {
  if (!display.goal.is_binary())
    return fmt::format("rank correlation {:.3f} with the picture's levels, limit {:g}", r.rank,
                       tolerance_of(run, "auc"));
  return describe_light(display, r) + fmt::format("d' {:.1f} (limit {:g}), AUC {:.3f} (limit {:g})",
                                                  r.score.contrast, tolerance_of(run, "contrast"),
                                                  r.score.auc, tolerance_of(run, "auc"));
}

std::string describe(const DisplayOutcome& display, const DisplayReading& r) {
  if (!display.goal.is_binary())
    return fmt::format("rank correlation {:.3f} with the picture's levels", r.rank);
  std::string text = describe_light(display, r) +
                     fmt::format("separation d' {:.1f}, AUC {:.3f}", r.score.contrast, r.score.auc);
  if (display.channel == optim::Channel::light) return text;
  return text +
         fmt::format("; mean {} {:.3f} and {:.3f}", to_string(display.channel), r.score.letter, r.score.rest);
}

Json starts_json(const optim::DisplayDesign& design) {
  Json starts = Json::array();
  for (const optim::DisplayStart& start : design.starts)
    starts.push_back({{"name", start.name},
                      {"auc", start.view.score.auc},
                      {"contrast", start.view.score.contrast},
                      {"separation", start.view.score.separation()},
                      {"cost", start.cost},
                      {"status", to_string(start.status)},
                      {"sharpened", start.sharpened}});
  return starts;
}

void add_drive(const optim::DisplayView& view, Json& display) {
  if (view.turn) {
    display["hinge"] = view.turn->hinge;
    display["angle_rad"] = view.turn->angle;
    return;
  }
  display["axis"] = view.plates.axis == model::Axis::x ? "x" : "y";
  display["compression"] = view.plates.compression;
}

Json loads_json(const PanelLoads& loads) {
  return {{"compression", loads.compression},
          {"force_N", loads.hinges.force_N},
          {"strain", loads.hinges.strain},
          {"auc", loads.auc},
          {"contrast", loads.contrast}};
}

Json printed_json(const PrintedDisplay& printed) {
  const auto numbers = [](const optim::DisplayTolerance& made) {
    return Json{{"contrast", made.contrast},
                {"contrast_p05", made.contrast_p05},
                {"contrast_p95", made.contrast_p05},
                {"auc", made.auc}};
  };
  return {{"holds", printed.holds()},
          {"why", printed.why},
          {"expected", numbers(printed.expected)},
          {"prints", numbers(printed.seen)},
          {"count", printed.prints},
          {"failed", printed.failed},
          {"confirmed", printed.is_confirmed()}};
}

std::string printed_text(const PrintedDisplay& printed, const Run& run) {
  std::string text = fmt::format(
      "separation d' {:.1f} expected, above {:.1f} in 95 % of prints, estimated for {}{}; AUC {:.3f}; {} "
      "simulated "
      "prints: {:.1f}, {:.1f}, {:.3f}",
      printed.expected.contrast, printed.expected.contrast_p05, run.design.process.name,
      printed.holds() ? "" : "; not every print meets the limits", printed.expected.auc, printed.prints,
      printed.seen.contrast, printed.seen.contrast_p05, printed.seen.auc);
  if (printed.failed > 0)
    text += fmt::format("; {} more have no equilibrium near the design", printed.failed);
  return text + (printed.is_confirmed() ? "" : "; the linear estimate is far from them");
}

std::string loads_text(const PanelLoads& loads) {
  const std::string drive =
      loads.turn
          ? fmt::format("turned by {:.1f} deg: ", std::abs(to_degrees(*loads.turn)))
          : fmt::format("compressed by {:.1f} %: {:.3g} N, ", 100 * loads.compression, loads.hinges.force_N);
  return fmt::format("{}strain {:.2f}, AUC {:.3f}, separation d' {:.1f}", drive, loads.hinges.strain,
                     loads.auc, loads.contrast);
}

/// Adds the required level of each cell, next to its bodies and hinges.
void add_levels(const std::vector<double>& levels, Json& cells) {
  for (std::size_t k = 0; k < levels.size(); ++k) {
    cells[k]["on"] = levels[k] >= targets::letter_level;
    cells[k]["level"] = levels[k];
  }
}

Json display_json(const DisplayOutcome& display, const Run& run) {
  const model::Lattice& panel = run.design.structure;
  const auto& shown = measure_of<DisplayMeasure>(run);
  Json out = {{"channel", to_string(display.channel)}};
  add_drive(display.design.view, out);
  out["levels"] = levels_of(display.goal, panel);
  out["before"] = score_json(display, shown.before);
  out["after"] = score_json(display, shown.reading);
  out["stretch_max"] = shown.stretch;
  out["starts"] = starts_json(display.design);
  out["reasons"] = run.violations;
  out["reasons_physics"] = run.physics_violations();
  if (const auto& scaled = display.design.scaled)
    out["scaled"] = {{"offset_mm", scaled->offset * panel.size().edge_mm},
                     {"theta_rad", scaled->theta},
                     {"walls_meet", !scaled->clear},
                     {"strained", display.design.refined},
                     {"rounds", scaled->rounds},
                     {"exact", score_json(display, display.exact)}};
  if (shown.printed) out["printed"] = printed_json(*shown.printed);
  if (display.loads) out["loads"] = loads_json(*display.loads);
  if (display.unlimited) out["unlimited"] = loads_json(*display.unlimited);
  if (const auto* physics = physics_measure_of<DisplayMeasure>(run))
    out["physics"] = score_json(display, physics->reading);
  if (!display.goal.whole && display.goal.needed) out["needed_cells"] = *display.goal.needed;
  if (shown.estimated) out["estimated_cells"] = *shown.estimated;
  return out;
}

Json optimiser_json(const DisplayOutcome& display) {
  return {{"solver", display.solver()},
          {"starts", display.design.starts.size()},
          {"evaluations", display.design.evaluations},
          {"status", to_string(display.design.status)},
          {"why", display.design.why},
          {"paths_from_flat", display.design.paths_from_flat}};
}

}  // namespace

bool PrintedDisplay::is_confirmed() const {
  constexpr double near = 0.3;   // largest difference, ratio to the contrast
  constexpr double lost = 0.05;  // largest share of failed prints: the results state what 95 of 100 keep
  if (prints + failed == 0) return true;
  return failed <= lost * (prints + failed) &&
         std::abs(seen.contrast - first_order_contrast) <= near * std::abs(first_order_contrast);
}

std::string DisplayOutcome::solver() const {
  return design.scaled ? "alternating directions" : to_string(options.solver.name);
}

void DisplayOutcome::add_sections(const Run& run, Json& result) const {
  result["target"] = {{"kind", "display"}, {"rows", goal.row_texts()}};
  result["display"] = display_json(*this, run);
  add_levels(levels_of(goal, run.design.structure), result["structure"]["cells"]);
  result["optimiser"] = optimiser_json(*this);
}

void DisplayOutcome::add_metrics(const Run& run, Json& metrics) const {
  const auto& shown = measure_of<DisplayMeasure>(run);
  const DisplayReading& after = shown.reading;
  metrics["auc"] = after.score.auc;
  metrics["contrast"] = after.score.contrast;
  metrics["separation"] = after.score.separation();
  metrics["rank"] = after.rank;
  metrics["auc_rest"] = shown.before.score.auc;
  metrics["contrast_rest"] = shown.before.score.contrast;
  metrics["stretch_max"] = shown.stretch;
  if (const auto light = light_of(*this, after)) {
    metrics["light_letter"] = (*light)[0];
    metrics["light_rest"] = (*light)[1];
    metrics["light_ratio"] = (*light)[0] / (*light)[1];
  }
  metrics["met"] = run.met();
  const auto* physics = physics_measure_of<DisplayMeasure>(run);
  if (!physics) return;
  metrics["auc_physics"] = physics->reading.score.auc;
  metrics["contrast_physics"] = physics->reading.score.contrast;
  metrics["separation_physics"] = physics->reading.score.separation();
  metrics["rank_physics"] = physics->reading.rank;
}

std::vector<SummaryLine> DisplayOutcome::summary_lines(const Run& run) const {
  const auto& shown = measure_of<DisplayMeasure>(run);
  std::vector<SummaryLine> lines;
  lines.push_back({"picture", describe_with_limits(*this, shown.reading, run)});
  if (!design.starts.empty())
    lines.push_back({"rule", "rule of the paper alone: AUC " +
                                 fmt::format("{:.3f}, separation d' {:.1f}", design.starts[0].view.score.auc,
                                             design.starts[0].view.score.contrast)});
  lines.push_back(
      {"search", fmt::format("{:.2g} s, {}, {} {}, {}", run.timings.optimise, solver(), design.evaluations,
                             design.scaled ? "iterations" : "evaluations", to_string(design.status))});
  if (shown.printed) lines.push_back({"print", printed_text(*shown.printed, run)});
  if (loads) lines.push_back({"limits", loads_text(*loads)});
  if (unlimited) lines.push_back({"", "without limits " + loads_text(*unlimited)});
  if (design.refined) lines.push_back({"strain", "on purpose; without it: " + describe(*this, exact)});
  if (const auto* physics = physics_measure_of<DisplayMeasure>(run))
    lines.push_back({"check", "picture in the simulation: " + describe(*this, physics->reading)});
  return lines;
}

std::vector<NamedContent> DisplayOutcome::pictures(const Run& run, bool for_report) const {
  return for_report ? far_pictures(run) : display_pictures(run);
}

namespace {

constexpr int large_panel = 40;     // cells: smaller panels show a letter or two, larger ones pictures
constexpr int pixels_of_large = 6;  // px per cell: 600 for a hundred cells
// Cells of a side per cell of blur: a QR code of 100 cells is read best at a blur of 1 to 1.33 cells.
constexpr double cells_per_blur = 80;
constexpr double surroundings = 12;  // cells: three modules of a QR code with four cells per module

constexpr double pixels_of_frame = 1000;  // px per side: a dozen frames make a film for a screen

/// Adds the picture of a state as SVG and as PNG.
void add_panel(std::vector<NamedContent>& files, const std::string& name, const model::Linkage& panel,
               const model::State& state, bool hinges = false) {
  for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png})
    files.push_back({name + (format == PictureFormat::svg ? ".svg" : ".png"),
                     panel_picture(panel, state, {.format = format, .hinges = hinges})});
}

void add_frames(std::vector<NamedContent>& files, const Run& run) {
  int frame = 0;
  for (const NamedState& state : run.states)
    if (state.name == "frame")
      files.push_back({fmt::format("frames/{:02}.png", frame++),
                       panel_picture(run.design.structure, state.poses,
                                     {.format = PictureFormat::png, .max_pixels = pixels_of_frame})});
}

}  // namespace

std::vector<NamedContent> display_pictures(const Run& run) {
  std::vector<NamedContent> files;
  const model::State flat = rest_state(run.design.structure);
  const model::State& after = run.states.front().poses;
  add_panel(files, "before", run.design.structure, flat);
  add_panel(files, "hinges", run.design.structure, flat, true);
  add_panel(files, "after", run.design.structure, after);
  for (NamedContent& file : far_pictures(run)) files.push_back(std::move(file));
  if (run.by_physics) add_panel(files, "physics", run.design.structure, run.verification->physics.state);
  add_frames(files, run);
  return files;
}

FarViewOptions far_view_options(const targets::DisplayGoal& goal) {
  const int side = std::min(goal.columns, goal.rows);
  FarViewOptions options;
  if (side < large_panel) return options;
  options.pixels_per_cell = pixels_of_large;
  options.blur_in_cells = std::max(options.blur_in_cells, side / cells_per_blur);
  options.surroundings_in_cells = surroundings;
  return options;
}

std::vector<NamedContent> far_pictures(const Run& run) {
  FarViewOptions options = far_view_options(outcome_of<DisplayOutcome>(run).goal);
  std::vector<NamedContent> files;
  for (const char* name : {"", "_enhanced"}) {
    options.enhanced = *name != 0;
    files.push_back({fmt::format("afar_before{}.png", name),
                     far_view(run.design.structure, rest_state(run.design.structure), options)});
    files.push_back({fmt::format("afar_after{}.png", name),
                     far_view(run.design.structure, run.states.front().poses, options)});
  }
  return files;
}

}  // namespace kinetix::app
