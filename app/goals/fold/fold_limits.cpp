#include "app/goals/fold/fold_limits.hpp"

#include <utility>

#include "app/pipeline/hinge_loads.hpp"
#include "app/pipeline/matter.hpp"

namespace kinetix::app {
namespace {

constexpr int theta_halvings = 5;  // of the range of theta, to a degree: a fold's loads change slowly with it

/// Of the design that makes up for its elastic hinges.
FoldLoads loads_of(const Run& run, const Scene& scene, const optim::FoldDesign& design,
                   const std::stop_token& stop) {
  Run trial;
  trial.hinge = run.hinge;
  trial.physics = run.physics;
  trial.goal_drive = run.goal_drive;
  trial.structure = design.folded.structure;
  trial.theta = design.folded.theta;
  trial.own_hinges = own_hinges_of(trial.structure, run.hinge_parts);
  trial.plan = make_plan(trial.structure, Model::exact);
  auto fold = std::make_unique<FoldOutcome>();
  fold->design = design;
  trial.goal = std::move(fold);
  const MatterPath found = path_in_matter(trial, scene, stop);
  return {found.theta, hinge_loads(found.path, found.drive, found.sheet, run.hinge, trial.own_hinges)};
}

}  // namespace

void keep_limits(const FoldFile& file, const Run& run, const Scene& scene, FoldOutcome& fold,
                 const std::function<optim::FoldDesign(double)>& search, const RunOptions& options) {
  if (!file.limits.any() || !fold.design.folds) return;
  fold.loads = loads_of(run, scene, fold.design, options.stop);
  if (share_of(file.limits, fold.loads->hinges) <= HingeLimits::in_hand) return;
  fold.unlimited = fold.loads;
  double kept = file.theta.lower, too_much = fold.design.folded.theta;
  for (int k = 0; k < theta_halvings && !options.stop.stop_requested(); ++k) {
    options.progress("limits", static_cast<double>(k) / theta_halvings);
    const double theta = (kept + too_much) / 2;
    optim::FoldDesign design = search(theta);
    if (!design.folds) {
      kept = theta;
      continue;
    }
    const FoldLoads loads = loads_of(run, scene, design, options.stop);
    const bool keeps = share_of(file.limits, loads.hinges) <= HingeLimits::in_hand;
    (keeps ? kept : too_much) = theta;
    if (!keeps) continue;
    fold.design = std::move(design);
    fold.loads = loads;
  }
}

}  // namespace kinetix::app
