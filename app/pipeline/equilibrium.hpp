#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Steps of the equilibrium path of a run, the same for every goal of a drive. Largest loads are those of steps: a forecast of
/// what a run reports takes the same steps.
model::EquilibriumPathOptions path_of_run(bool planar);

/// Result of following a drive with elastic hinges.
struct ElasticState {
  Equilibrium equilibrium;
  double theta = 0;  ///< rad, where the path ended
  std::vector<NamedState>
      states;  ///< the last one, that of the closed form under the same drive, frames of the motion
  std::vector<Fidelity> fidelity;  ///< a row for each of the first two
  std::vector<std::string> why;    ///< sentences of the plan
};

/// Follows the equilibrium of a design to the goal of a drive, with the stable states that a release on the way leads to, and the
/// closed form's state of the same drive where there is one. After a stop request, the same of the path up to there.
/// @param frames about how many states of the motion to keep, flat and last included, >= 2   @pre planned
/// @param bodies that press on each other in place of walls; null: the walls
ElasticState follow_drive(const Found& found, const model::LinkageDrive& drive,
                          const model::Elasticity& elasticity, int frames, const RunOptions& options,
                          std::shared_ptr<const model::ConvexBodies> bodies = {});

/// The run with these states after its own.
Run with_states(Run run, ElasticState state);

/// Theta of the sheet where a path came to, rad: that of the closed form under the same drive where it is near, else half the turns
/// of its hinges. That of plates, by their distance alone, is another where rows lean; a cord and springs only pull that way.
/// @param exact motion of the sheet, where it has one
double reached_theta(const model::Lattice& sheet, const model::ExactMotion& exact,
                     const model::LinkageDrive& drive, const model::EquilibriumPath& path,
                     const model::Elasticity& elasticity);

}  // namespace kinetix::app
