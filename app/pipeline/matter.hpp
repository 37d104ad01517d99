#pragma once

#include "app/run/goal.hpp"

namespace kinetix::app {

/// Whether the goal was searched for by closed form and its file says what elastic hinges are made of.
bool is_of_matter(const Found& found);

/// The drive of a goal that takes a sheet to theta, rad.
model::LinkageDrive goal_drive(const Found& found, const model::Lattice& sheet, double theta);

/// A design that makes up for its elastic hinges, and its path from flat.
struct MatterPath {
  model::Lattice sheet;
  double theta = 0;  ///< rad, of its drive
  model::LinkageDrive drive;
  model::EquilibriumPath path;
};

/// Follows the exact design of a goal, and the design that makes up for its elastic hinges. Without an equilibrium the path ends
/// before its goal.
/// @pre planned, is_of_matter
MatterPath path_in_matter(const Found& found, const Goal& goal, const std::stop_token& stop);

/// Takes a design that meets its goal exactly to the equilibrium of its elastic hinges, from flat by its drive, and
/// brings that onto the goal (optim/matter/compensate.hpp). The run then shows the equilibrium of the new design, as
/// the path from flat comes to it. Without an equilibrium the exact state stays, and the goal says why it is not met.
/// @pre measured, is_of_matter
Run settled_in_matter(Run run, const Goal& goal, const RunOptions& options);

}  // namespace kinetix::app
