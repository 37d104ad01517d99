#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Returns the options of a run's equilibrium path, the same for every goal of a drive. The largest load is that of a
/// step, so a forecast must take the same steps as the run.
model::EquilibriumPathOptions path_of_run(bool planar);

/// Result of following a drive with elastic hinges.
struct ElasticState {
  Equilibrium equilibrium;
  double theta = 0;                ///< rad, where the path ended
  std::vector<NamedState> states;  ///< end of the path, closed form of the same drive, frames
  std::vector<Fidelity> fidelity;  ///< one row for each of the first two states
  std::vector<std::string> why;    ///< sentences for the plan
};

/// Follows the equilibrium of a design to the goal of a drive. Adds the stable states that a release on the path
/// leads to, and the closed form's state of the same drive if it exists. After a stop request, the result covers the
/// path so far.
/// @param frames approximate number of states of the motion to keep, flat and last included, >= 2   @pre planned
/// @param bodies press on each other in place of walls; null: the walls
ElasticState follow_drive(const Found& found, const model::LinkageDrive& drive,
                          const model::Elasticity& elasticity, int frames, const RunOptions& options,
                          std::shared_ptr<const model::ConvexBodies> bodies = {});

/// Returns the run with these states appended to its own.
Run with_states(Run run, ElasticState state);

/// Returns theta at the end of a path, rad. It is that of the closed form under the same drive if the path is near
/// it, else the mean half turn of the hinges. The distance of plates alone gives a different theta if rows lean. A
/// tendon or springs only pull towards theirs.
/// @param exact motion of the sheet, if it has one
double reached_theta(const model::Lattice& sheet, const model::ExactMotion& exact,
                     const model::LinkageDrive& drive, const model::EquilibriumPath& path,
                     const model::Elasticity& elasticity);

}  // namespace kinetix::app
