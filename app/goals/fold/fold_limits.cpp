#include "app/goals/fold/fold_limits.hpp"

#include <utility>

#include "app/goals/fold/crease_checks.hpp"
#include "app/pipeline/hinge_loads.hpp"
#include "app/pipeline/matter.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app {
namespace {

constexpr int theta_halvings = 5;  // of the range of theta, to a degree: a fold's loads change slowly with it
// rad: ranges as narrow as a robust search tries hold one theta.
constexpr double one_theta = 0.5 * radians_per_degree;

/// What a design that makes up for its elastic hinges bears, and whether it still folds into its goal.
struct Borne {
  FoldLoads loads;
  bool meets_goal = false;
};

bool meets_goal(const FoldFile& file, const optim::FoldDesign& design, const MatterPath& found) {
  FoldOutcome outcome;
  outcome.goal = file.goal;
  outcome.design = design;
  optim::FoldedNet& net = outcome.design.folded;
  net.error = fold_error(net.net, net.layout, net.structure, found.path.state, net.theta);
  return found.path.stop == model::EquilibriumPath::Stop::reached &&
         violations(file, outcome.creases(net.error), net.error.rms, "equilibrium").empty();
}

Borne borne_by(const FoldFile& file, Found trial, const Goal& goal, const optim::FoldDesign& design,
               const std::stop_token& stop) {
  trial.design.structure = design.folded.structure;
  trial.theta = design.folded.theta;
  auto fold = std::make_unique<FoldOutcome>();
  fold->design = design;
  trial.goal = std::move(fold);
  trial = planned(std::move(trial));
  const MatterPath found = path_in_matter(trial, goal, stop);
  return {{model::mean_theta(found.sheet, found.path.state),
           hinge_loads(found.path, found.drive, found.sheet, trial.design.hinge, trial.design.own_hinges)},
          meets_goal(file, design, found)};
}

}  // namespace

void keep_limits(const FoldFile& file, const Found& asked_of, const Goal& goal, FoldOutcome& fold,
                 const std::function<optim::FoldDesign(double)>& search, const RunOptions& options) {
  if (!file.limits.any() || !fold.design.folds) return;
  const FoldLoads asked = borne_by(file, asked_of, goal, fold.design, options.stop).loads;
  if (options.stop.stop_requested()) return;  // cut short, its path says nothing of the fold
  fold.loads = asked;
  if (share_of(file.limits, asked.hinges) <= HingeLimits::in_hand) return;
  double kept = file.theta.lower, too_much = fold.design.folded.theta;
  for (int k = 0; k < theta_halvings && too_much - kept > one_theta; ++k) {
    options.progress("limits", static_cast<double>(k) / theta_halvings);
    const double theta = (kept + too_much) / 2;
    optim::FoldDesign design = search(theta);
    if (options.stop.stop_requested()) return;
    if (!design.folds) {
      kept = theta;
      continue;
    }
    const Borne borne = borne_by(file, asked_of, goal, design, options.stop);
    if (options.stop.stop_requested()) return;
    if (!(share_of(file.limits, borne.loads.hinges) <= HingeLimits::in_hand)) {
      too_much = theta;
      continue;
    }
    kept = theta;
    // Hinges of a sheet that stays short of its goal are strained little: that is no way to keep limits.
    if (!borne.meets_goal) continue;
    fold.design = std::move(design);
    fold.loads = borne.loads;
    fold.unlimited = asked;
  }
}

}  // namespace kinetix::app
