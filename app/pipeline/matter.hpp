#pragma once

#include "app/run/goal.hpp"

namespace kinetix::app {

/// Whether the goal was searched for by closed form and its hinges are elastic.
bool has_elastic_hinges(const Found& found);

/// Returns the drive that takes a sheet to theta, rad: the goal's springs, at rest there, or the usual drive without
/// springs.
model::LinkageDrive goal_drive(const Found& found, const model::Lattice& sheet, double theta);

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
CompensatedPath path_in_matter(const Found& found, const Goal& goal, const std::stop_token& stop);

/// Compensates a design that meets its goal exactly for its elastic hinges. Its drive folds it from flat to an
/// equilibrium, and a search brings that onto the goal (optim/matter/compensate.hpp). The run then shows the
/// equilibrium of the new design at the end of its path from flat. Without an equilibrium the exact state stays, and
/// the violations give the reason.
/// @pre measured, has_elastic_hinges
Run compensate_for_elasticity(Run run, const Goal& goal, const RunOptions& options);

}  // namespace kinetix::app
