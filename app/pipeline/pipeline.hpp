#pragma once

#include "app/run/goal.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Searches for the goal, and says of what was found what each model says of it: the exact state, the equilibrium of elastic
/// hinges, then the physics run, prints and contact side by side.
/// @throws InvalidInput for a target that leaves nothing to search
Run run_goal(const Goal& goal, const RunOptions& options);

/// The same of a design as it is, nothing to search for.
/// @param model exact: one state of the closed form; equilibrium: of the design's elastic hinges, followed
/// from flat to its drive, the closed form of the same drive beside it where a family fits; bullet: the
/// physics run, compared with the equilibrium where hinges are elastic, else with the exact state where a
/// family fits; elsewhere there is none, and the run is judged by its own closure alone
/// Imported bodies have no family: their exact state is closed step by step along the drive.
/// @throws InvalidInput for a design that its model does not fit
Run run_design(Design design, Model model, RunOptions options);

/// What was found in the state that its model holds it in, and how far that is from its goal. @param goal null for a design
Run held(Found found, const Goal* goal, const RunOptions& options);
/// The same in the equilibrium of its elastic hinges, where a goal of an exact family has any.
Run settled(Run run, const Goal& goal, const RunOptions& options);

}  // namespace kinetix::app
