#include "app/goals/display/display_pictures.hpp"

#include <fmt/format.h>

#include "app/goals/display/display_outcome.hpp"
#include "app/pictures/far_view.hpp"
#include "app/pictures/panel_picture.hpp"

namespace kinetix::app {
namespace {

/// As SVG and as PNG.
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
                       panel_picture(run.structure, state.poses, {.format = PictureFormat::png})});
}

}  // namespace

std::vector<NamedContent> display_pictures(const Run& run) {
  std::vector<NamedContent> files;
  const model::State flat = rest_state(run.structure);
  const model::State& after = run.states.front().poses;
  add_panel(files, "before", run.structure, flat);
  add_panel(files, "hinges", run.structure, flat, true);
  add_panel(files, "after", run.structure, after);
  files.push_back({"afar_before.png", far_view(run.structure, flat)});
  files.push_back({"afar_after.png", far_view(run.structure, after)});
  if (outcome_of<DisplayOutcome>(run).physics)
    add_panel(files, "physics", run.structure, run.verification->physics.state);
  add_frames(files, run);
  return files;
}

}  // namespace kinetix::app
