#include "app/display_json.hpp"

#include <fmt/format.h>

#include "app/far_view.hpp"
#include "app/panel_picture.hpp"

namespace kinetix {
namespace {

using Json = nlohmann::ordered_json;

Json score_json(const DisplayReading& reading) {
  return {{"contrast", reading.score.contrast}, {"auc", reading.score.auc},
          {"letter", reading.score.letter},     {"rest", reading.score.rest},
          {"rank", reading.rank},               {"cells", reading.channel}};
}

std::string in_words(const DisplayOutcome& display, const DisplayReading& r) {
  if (!display.goal.is_binary()) return fmt::format("rank correlation {:.3f} with the picture's levels", r.rank);
  return fmt::format("auc {:.3f}, contrast {:.1f}, {} of letter and rest {:.3f} and {:.3f}", r.score.auc,
                     r.score.contrast, to_string(display.channel), r.score.letter, r.score.rest);
}

}  // namespace

Json display_json(const Run& run) {
  const DisplayOutcome& display = *run.display;
  Json starts = Json::array();
  for (const DisplayStart& start : display.design.starts)
    starts.push_back({{"name", start.name},
                      {"contrast", start.view.score.contrast},
                      {"auc", start.view.score.auc},
                      {"separation", start.view.score.separation()},
                      {"cost", start.cost},
                      {"status", to_string(start.status)},
                      {"sharpened", start.sharpened}});
  const Drive& plates = display.design.view.plates;
  Json out = {{"channel", to_string(display.channel)},
              {"axis", plates.axis == Axis::x ? "x" : "y"},
              {"compression", plates.compression},
              {"levels", levels_of(display.goal, run.structure)},
              {"before", score_json(display.before)},
              {"after", score_json(display.after)},
              {"stretch_max", display.design.view.stretch},
              {"starts", starts},
              {"reasons", display.why_missed},
              {"reasons_physics", display.why_physics}};
  if (display.physics) out["physics"] = score_json(*display.physics);
  if (const auto needed = display.needed()) {
    out["needed_cells"] = *needed;
    out["needed_for"] = display.goal.whole ? "contrast" : "strokes";
  }
  if (!display.larger.tried.empty()) out["larger_panels_tried"] = display.larger.tried;
  return out;
}

Json display_target_json(const DisplayOutcome& display) {
  return {{"kind", "display"}, {"rows", display.goal.row_texts()}};
}

Json display_optimiser_json(const DisplayOutcome& display) {
  return {{"solver", to_string(display.options.solver.name)},
          {"starts", display.design.starts.size()},
          {"evaluations", display.design.evaluations},
          {"status", to_string(display.design.status)},
          {"why", display.design.why},
          {"paths_from_flat", display.design.paths_from_flat}};
}

void add_display_metrics(const DisplayOutcome& display, Json& metrics) {
  metrics["contrast"] = display.after.score.contrast;
  metrics["auc"] = display.after.score.auc;
  metrics["separation"] = display.after.score.separation();
  metrics["rank"] = display.after.rank;
  metrics["contrast_rest"] = display.before.score.contrast;
  metrics["auc_rest"] = display.before.score.auc;
  metrics["stretch_max"] = display.design.view.stretch;
  metrics["met"] = display.met();
  if (!display.physics) return;
  metrics["contrast_physics"] = display.physics->score.contrast;
  metrics["auc_physics"] = display.physics->score.auc;
  metrics["separation_physics"] = display.physics->score.separation();
  metrics["rank_physics"] = display.physics->rank;
}

std::vector<std::array<std::string, 2>> display_lines(const Run& run) {
  const DisplayOutcome& display = *run.display;
  std::vector<std::array<std::string, 2>> lines;
  lines.push_back({"picture", in_words(display, display.after) + (display.met() ? "" : ": NOT AS ASKED")});
  for (const std::string& why : display.why_missed) lines.push_back({"why", why});
  if (!display.design.starts.empty())
    lines.push_back({"rule", "the paper's rule alone: auc " +
                                 fmt::format("{:.3f}, contrast {:.1f}", display.design.starts[0].view.score.auc,
                                             display.design.starts[0].view.score.contrast)});
  lines.push_back({"search", fmt::format("{:.2f} s, {}, {} evaluations, {}", run.timings.optimise,
                                         to_string(display.options.solver.name), display.design.evaluations,
                                         to_string(display.design.status))});
  if (display.physics) lines.push_back({"seen", "in the physics run: " + in_words(display, *display.physics)});
  for (const std::string& why : display.why_physics) lines.push_back({"why", why});
  return lines;
}

std::vector<std::pair<std::string, std::string>> display_pictures(const Run& run) {
  std::vector<std::pair<std::string, std::string>> files;
  const auto add = [&](const std::string& name, const State& state, bool hinges) {
    for (const PictureFormat format : {PictureFormat::svg, PictureFormat::png})
      files.emplace_back(name + (format == PictureFormat::svg ? ".svg" : ".png"),
                         panel_picture(run.structure, state, {.format = format, .hinges = hinges}));
  };
  const State flat = rest_state(run.structure);
  add("before", flat, false);
  add("hinges", flat, true);
  add("after", run.states.front().poses, false);
  files.emplace_back("afar_before.png", far_view(run.structure, flat));
  files.emplace_back("afar_after.png", far_view(run.structure, run.states.front().poses));
  if (run.display->physics) add("physics", run.verification->physics.state, false);
  int frame = 0;
  for (const NamedState& state : run.states)
    if (state.name == "frame")
      files.emplace_back(fmt::format("frames/{:02}.png", frame++),
                         panel_picture(run.structure, state.poses, {.format = PictureFormat::png}));
  return files;
}

}  // namespace kinetix
