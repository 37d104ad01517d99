#include "app/goals/display/search_panel.hpp"

#include "model/lattice/lattice_motion.hpp"
#include "targets/display/panel_levels.hpp"

namespace kinetix::app {
namespace {

optim::ScaledDisplayOptions scaled_options(const DisplayFile& file) {
  optim::ScaledDisplayOptions options;
  options.compression = file.compression_range.value_or(std::array{file.compression, file.compression});
  options.offset = file.offset;
  options.t = file.t;
  if (!file.by_hinge) return options;
  options.free_to = file.angle / 2;
  options.hinge = file.driven_hinge;
  return options;
}

}  // namespace

model::Plates plates_of(const DisplayFile& file) {
  return {.axis = file.axes.front(), .compression = file.compression};
}

optim::DisplayOptions search_options(const DisplayFile& file, const model::Elasticity& elasticity,
                                     const RunOptions& run) {
  optim::DisplayOptions options;
  options.channel = file.channel;
  options.plates = plates_of(file);
  options.axes = file.axes;
  options.compression = file.compression_range;
  options.elasticity = elasticity;
  options.stretch = file.stretch;
  options.t = file.t;
  options.symmetry = file.symmetry;
  options.starts = file.solver.starts.value_or(options.starts);
  options.threads = run.threads;
  options.seed = run.seed;
  options.solver.stop = run.stop;
  options.solver.name = file.solver.name.value_or(options.solver.name);
  options.solver.max_evaluations = file.solver.max_evaluations.value_or(options.solver.max_evaluations);
  return options;
}

optim::DisplayDesign search_panel(const DisplayFile& file, const model::Lattice& panel,
                                  const optim::DisplayOptions& options, const Progress& progress) {
  const std::vector<double> levels = levels_of(file.goal, panel);
  if (file.offset > 0)
    return fit_scaled_display(panel, levels, file.channel, file.axes, scaled_options(file));
  return fit_display(*panel.squares(), levels, options, progress);
}

void refine_panel(const DisplayFile& file, const targets::DisplayGoal& goal, const model::Lattice& panel,
                  optim::DisplayOptions options, optim::DisplayDesign& design, const Progress& progress) {
  progress("strain on purpose", 0);
  options.offset = file.offset;
  options.stretch = file.strain;
  refine_display(panel, levels_of(goal, panel), options, design);
  progress("strain on purpose", 1);
}

// Offsets pass through mm, so that they equal those read back from a file to the last bit.
void place_hinges(const optim::DisplayView& view, model::Lattice& panel) {
  const double mm = panel.size().edge_mm;
  for (int h = 0; h < panel.hinges(); ++h) {
    model::HingeParameters& p = panel.hinge(h);
    p.t = view.t[h];
    if (view.offset.size() > 0) p.offset = view.offset[h] * mm / mm;
  }
}

DisplayReading read_panel(const DisplayFile& file, const model::Lattice& panel, const model::State& state) {
  const std::vector<double> levels = levels_of(file.goal, panel);
  DisplayReading out;
  out.channel = channel_values(file.channel, panel, state);
  out.channel.resize(levels.size());
  out.score = targets::display_score(out.channel, levels);
  out.rank = targets::rank_correlation(out.channel, levels);
  return out;
}

DisplayReading read_shown_panel(const DisplayFile& file, const model::Lattice& panel,
                                const model::State& state) {
  DisplayReading out = read_panel(file, panel, state);
  if (file.goal.is_binary() && file.channel != optim::Channel::light) {
    std::vector<double> light = channel_values(optim::Channel::light, panel, state);
    light.resize(out.channel.size());
    const targets::DisplayScore score = targets::display_score(light, levels_of(file.goal, panel));
    out.light = {score.letter, score.rest};
  }
  if (file.goal.is_text) out.seen = seen_topology(file.goal, in_order_of_goal(file.goal, panel, out.channel));
  return out;
}

model::Drive drive_of(const optim::DisplayView& view) {
  if (view.turn) return *view.turn;
  return view.plates;
}

model::Lattice make_panel(const DisplayFile& file, targets::PanelSize size) {
  return make_sheet(file.lattice, model::lattice_cells(size[0], size[1]), file.size);
}

}  // namespace kinetix::app
