#include "app/run_curve.hpp"

#include <fmt/format.h>

#include "app/design_motion.hpp"
#include "app/stopwatch.hpp"
#include "app/verify.hpp"

namespace kinetix {
namespace {

CurveVariables variables_of(const TargetFile& file) {
  CurveVariables v;
  v.columns = file.columns;
  v.rows = file.rows;
  v.cell_mm = file.size.edge_mm;
  v.beta = file.beta;
  v.theta = file.theta;
  v.per = file.per;
  v.symmetry = file.symmetry;
  return v;
}

MultiStartOptions search_of(const TargetFile& file, const RunOptions& options) {
  MultiStartOptions search;
  search.threads = options.threads;
  search.seed = options.seed;
  search.starts = file.solver.starts.value_or(search.starts);
  search.solver.name = file.solver.name.value_or(search.solver.name);
  search.solver.max_evaluations = file.solver.max_evaluations.value_or(search.solver.max_evaluations);
  return search;
}

std::vector<std::string> why_missed(const FreeCurveDesign& found, double tolerance) {
  std::vector<std::string> why;
  const double rms = found.design.error.rms;
  if (!(rms <= tolerance)) {
    why = found.design.reach.obstacles;
    if (why.empty())
      why.push_back(
          fmt::format("no start came closer than {:.3g} of the diagonal, though no column alone lacks turn: "
                      "use more or smaller cells",
                      rms));
  }
  if (!found.walls_are_free)
    why.push_back(found.notes.back() + ": lower or thinner walls, or larger cells, would pass");
  return why;
}

}  // namespace

Run run_curve(const TargetFile& file, const RunOptions& options) {
  Run run;
  run.name = file.name;
  run.seed = options.seed;
  run.physics = file.physics;
  run.shape_tolerance = file.shape_tolerance;
  run.verify_tolerance = file.verify_tolerance;

  Stopwatch watch;
  const MultiStartOptions search = search_of(file, options);
  if (options.progress) options.progress("search", 0);
  FreeCurveDesign found = fit_free_curve(file.curve, variables_of(file), file.size, search);
  run.timings.optimise = watch.lap();

  run.structure = make_structure(rectangle(file.columns, file.rows), file.size);
  apply(found.design.design, run.structure);
  run.theta = found.design.design.theta;
  run.plan = make_plan(run.structure);
  run.plan.why.insert(run.plan.why.end(), found.notes.begin(), found.notes.end());
  run.timings.plan = watch.lap();

  std::vector<std::string> why = why_missed(found, file.shape_tolerance);
  const bool met = why.empty();
  run.curve = CurveOutcome{file.curve.points(), std::move(found.design), search.solver, met, std::move(why)};
  const State exact = fold(run.plan.family, run.structure, run.theta);
  run.states.push_back({"target", "exact", run.theta, exact, hinge_gaps(run.structure, exact)});
  run.fidelity.push_back(exact_fidelity(run.plan.family, run.structure, run.theta));
  if (options.verify) {
    verify(run, exact, drive_to(run.structure, run.theta), physics_options(file.physics, file.size.edge_mm),
           options.progress);
    run.timings.verify = watch.lap();
  }
  for (NamedState& frame : motion_frames(run.plan.family, run.structure, run.theta, 13))
    run.states.push_back(std::move(frame));
  return run;
}

}  // namespace kinetix
