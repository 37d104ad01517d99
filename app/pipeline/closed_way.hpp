#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/deployment.hpp"

namespace kinetix::app {

/// Returns the pull of a design of imported bodies, moved to where they are; empty if the drive turns a hinge.
std::optional<model::Pull> pull_of(const Design& design);

/// Rejects what the equilibrium model cannot solve: it turns one hinge, and supports only hinges with an axis.
/// @throws InvalidInput for bodies that are pulled, and for ball hinges
void require_one_axis(const model::Assembly& bodies, bool are_pulled);

/// Adds the states along the drive to a run of imported bodies: closed states or, if the plan says so, the
/// equilibrium of its elastic hinges. Its drive then names the hinge that is turned.
/// @throws InvalidInput for a drive that turns a hinge which cannot turn at rest; in equilibrium for bodies that are
/// pulled, and for hinges without an axis
Run with_closed_way(Run run, const RunOptions& options);

/// Adds the convex pieces by which the bodies of the run collide: those of the options if they fit. @pre imported
/// bodies
Run with_pieces(Run run, const RunOptions& options);

}  // namespace kinetix::app
