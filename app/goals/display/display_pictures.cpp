#include "app/goals/display/display_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/goals/display/display_outcome.hpp"
#include "app/pictures/panel_picture.hpp"

namespace kinetix::app {
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
                                     {.format = PictureFormat::png, .most_pixels = pixels_of_frame})});
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
