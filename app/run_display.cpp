#include "app/run_display.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/balance.hpp"
#include "app/design_motion.hpp"
#include "app/larger_panels.hpp"
#include "app/panel_memory.hpp"
#include "app/stopwatch.hpp"
#include "app/verify.hpp"

namespace kinetix {
namespace {

constexpr int frames = 13;

Drive plates_of(const DisplayFile& file) {
  Drive drive;
  drive.kind = Drive::Kind::plates;
  drive.axis = file.axes.front();
  drive.compression = file.compression;
  return drive;
}

DisplayOptions search_of(const DisplayFile& file, const Elasticity& elasticity, const RunOptions& run) {
  DisplayOptions options;
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
  options.solver.name = file.solver.name.value_or(options.solver.name);
  options.solver.max_evaluations = file.solver.max_evaluations.value_or(options.solver.max_evaluations);
  return options;
}

DisplayReading reading(const Structure& panel, const State& state, const std::vector<double>& levels,
                       Channel channel) {
  DisplayReading out;
  out.channel = channel_values(channel, panel, state);
  out.score = display_score(out.channel, levels);
  out.rank = rank_correlation(out.channel, levels);
  return out;
}

std::string lost_strokes(const DisplayGoal& goal) {
  const std::string what = "strokes or gaps are thinner than a cell, so that parts of the picture are lost: ";
  if (!goal.needed) return what + "no panel that is allowed shows it whole";
  return what + fmt::format("the smallest panel that shows it whole has [{}, {}] cells", (*goal.needed)[0],
                            (*goal.needed)[1]);
}

std::string about_larger(const LargerPanels& larger) {
  const auto named = [](PanelSize size) { return fmt::format("[{}, {}]", size[0], size[1]); };
  if (larger.enough)
    return fmt::format("a panel of {} cells shows it within these bounds", named(*larger.enough));
  std::vector<std::string> names;
  for (const PanelSize size : larger.tried) names.push_back(named(size));
  return fmt::format("no larger panel that was tried shows it within these bounds either: {}",
                     fmt::join(names, ", "));
}

/// Whether larger panels are worth a search: where the picture has all its strokes and is not clear enough.
bool wants_more_cells(const DisplayFile& file, const DisplayOutcome& display) {
  const DisplayView& view = display.design.view;
  return file.goal.whole && view.balanced &&
         !misses(file, display.after.score, display.after.rank, "model").empty();
}

std::vector<std::string> why_missed(const DisplayFile& file, const DisplayOutcome& display) {
  std::vector<std::string> why;
  if (!display.design.view.balanced) {
    why.push_back("no balance of the panel was found at this compression: compress less");
    return why;
  }
  why = misses(file, display.after.score, display.after.rank, "model");
  if (!(display.design.view.stretch <= file.stretch))
    why.push_back(fmt::format("a hinge stretches by {:.3f} cell edges, allowed are {:.3f}",
                              display.design.view.stretch, file.stretch));
  if (!display.goal.whole) why.push_back(lost_strokes(display.goal));
  if (!display.larger.tried.empty()) why.push_back(about_larger(display.larger));
  return why;
}

/// The physics run, and what its last state shows.
void verify_display(Run& run, const DisplayFile& file, const State& reference, const Elasticity& elasticity,
                    const std::vector<double>& levels, const Progress& progress) {
  verify(run, reference, run.display->design.view.plates,
         elastic_physics(elasticity, file.physics, file.size.edge_mm, run.plan.planar), progress);
  Verification& v = *run.verification;
  if (v.physics.status != PhysicsResult::Status::settled) return;
  DisplayOutcome& display = *run.display;
  display.physics = reading(run.structure, v.physics.state, levels, file.channel);
  display.why_physics = misses(file, display.physics->score, display.physics->rank, "physics run");
  v.agrees = v.agrees && display.why_physics.empty();
}

}  // namespace

Run run_display(const DisplayFile& file, const RunOptions& options) {
  Run run;
  run.name = file.name;
  run.seed = options.seed;
  run.physics = file.physics;
  run.hinge = file.hinge;
  run.hinge.model = HingeSection::Model::elastic;
  run.verify_tolerance = file.verify;

  Stopwatch watch;
  const Elasticity elasticity = elasticity_of(file.hinge, file.physics, file.size.edge_mm);
  const DisplayOptions search = search_of(file, elasticity, options);
  check_memory({file.goal.columns, file.goal.rows}, options.threads,
               search.starts * static_cast<int>(search.axes.size()), memory_of_machine());
  run.structure = make_structure(rectangle(file.goal.columns, file.goal.rows), file.size);
  const std::vector<double> levels = levels_of(file.goal, run.structure);
  DisplayOutcome display;
  display.goal = file.goal;
  display.channel = file.channel;
  display.options = search;
  display.design = fit_display(run.structure, levels, display.options, options.progress);
  run.timings.optimise = watch.lap();

  DisplayView& view = display.design.view;
  if (!view.balanced) view.plates = display.options.plates;
  run.drive = DriveSection{.axis = view.plates.axis, .compression = view.plates.compression};
  if (view.balanced)
    for (std::size_t h = 0; h < run.structure.hinges.size(); ++h)
      run.structure.hinges[h].parameters.t = view.t[static_cast<Eigen::Index>(h)];
  run.plan = make_plan(run.structure, Model::equilibrium);
  run.timings.plan = watch.lap();
  display.before = reading(run.structure, rest_state(run.structure), levels, file.channel);
  add_balance(run, view.plates, elasticity, frames, options.progress);
  const State after = run.states.front().poses;
  display.after = reading(run.structure, after, levels, file.channel);
  run.timings.balance = watch.lap();
  if (wants_more_cells(file, display))
    display.larger = search_larger_panels(file, display.options, options.progress);
  run.timings.larger_panels = watch.lap();
  display.why_missed = why_missed(file, display);
  run.display = std::move(display);
  if (options.verify && run.equilibrium->reached())
    verify_display(run, file, after, elasticity, levels, options.progress);
  run.timings.verify = watch.lap();
  return run;
}

}  // namespace kinetix
