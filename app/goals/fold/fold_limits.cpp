#include "app/goals/fold/fold_limits.hpp"

#include <utility>

#include "app/pipeline/hinge_loads.hpp"
#include "app/pipeline/matter.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app {
namespace {

constexpr int theta_halvings = 5;  // down to a degree of theta: loads of a fold change slowly with it
// rad: narrower ranges count as one theta, as in the trials of a robust search.
constexpr double one_theta = 0.5 * radians_per_degree;

/// Loads of a design compensated for its elastic hinges, and whether it still folds into its goal.
struct Borne {
  FoldLoads loads;
  bool meets_goal = false;
};

Borne borne_by(const FoldFile& file, Found trial, const Goal& goal, const optim::FoldDesign& design,
               const std::stop_token& stop) {
  const FoldShape shape = shape_of(file.goal, design);
  trial.design.structure = design.folded.structure;
  trial.theta = design.folded.theta;
  trial.goal = std::make_unique<FoldOutcome>(shape);
  trial = planned(std::move(trial));
  const CompensatedPath found = path_in_matter(trial, goal, stop);
  return {
      {model::mean_theta(found.sheet, found.path.state),
       hinge_loads(found.path, found.drive, found.sheet, trial.design.hinge, trial.design.hinge_overrides)},
      found.path.stop == model::EquilibriumPath::Stop::reached &&
          shape.violations(file, shape.error_of(found.path.state), "equilibrium").empty()};
}

}  // namespace

KeptLoads keep_limits(const FoldFile& file, const Found& asked_of, const Goal& goal,
                      optim::FoldDesign& design, const std::function<optim::FoldDesign(double)>& search,
                      const RunOptions& options) {
  if (!file.limits.any() || !design.folds) return {};
  const FoldLoads asked = borne_by(file, asked_of, goal, design, options.stop).loads;
  if (options.stop.stop_requested()) return {};  // an interrupted path does not reach the fold
  KeptLoads out{asked, {}};
  if (share_of(file.limits, asked.hinges) <= HingeLimits::in_hand) return out;
  const auto keeps = [&](double theta, double share) -> std::optional<bool> {
    options.progress("limits", share);
    optim::FoldDesign next = search(theta);
    if (options.stop.stop_requested()) return std::nullopt;
    if (!next.folds) return true;
    const Borne borne = borne_by(file, asked_of, goal, next, options.stop);
    if (options.stop.stop_requested()) return std::nullopt;
    if (!(share_of(file.limits, borne.loads.hinges) <= HingeLimits::in_hand)) return false;
    // A sheet that does not reach its goal strains its hinges little, which is not a way to keep the limits.
    if (!borne.meets_goal) return true;
    design = std::move(next);
    out = {borne.loads, asked};
    return true;
  };
  halve({file.theta.lower, design.folded.theta}, {theta_halvings, one_theta}, keeps);
  return out;
}

}  // namespace kinetix::app
