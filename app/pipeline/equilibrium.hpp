#pragma once

#include "app/run/goal.hpp"
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
ElasticState follow_drive(const SearchResult& found, const model::LinkageDrive& drive,
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

/// Whether the goal was searched for by closed form and its hinges are elastic.
bool has_elastic_hinges(const SearchResult& found);

/// Returns the drive that takes a sheet to theta, rad: the goal's springs, at rest there, or the usual drive without
/// springs.
model::LinkageDrive goal_drive(const SearchResult& found, const model::Lattice& sheet, double theta);

/// Design compensated for its elastic hinges, and its path from flat.
struct CompensatedPath {
  model::Lattice sheet;
  double theta = 0;  ///< rad, of its drive
  model::LinkageDrive drive;
  model::EquilibriumPath path;
};

/// Compensates the exact design of a goal for its elastic hinges and follows the new design from flat. If the exact
/// design does not reach an equilibrium, returns that design and its incomplete path.
/// @pre planned, has_elastic_hinges
CompensatedPath trace_compensated_path(const SearchResult& found, const Goal& goal,
                                       const std::stop_token& stop);

/// Compensates a design that meets its goal exactly for its elastic hinges. Its drive folds it from flat to an
/// equilibrium, and a search brings that onto the goal (optim/elastic/compensation.hpp). The run then shows the
/// equilibrium of the new design at the end of its path from flat. Without an equilibrium the exact state stays, and
/// the violations give the reason.
/// @pre measured, has_elastic_hinges
Run compensate_for_elasticity(Run run, const Goal& goal, const RunOptions& options);

}  // namespace kinetix::app
