#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/deployment.hpp"

namespace kinetix::app {

/// The pull of a design of imported bodies, moved to where they are; nothing where a hinge is turned.
std::optional<model::Pull> pull_of(const Design& design);

/// For equilibria, which turn one hinge and know hinges with an axis only. @throws InvalidInput
void require_one_axis(const model::Assembly& bodies, bool are_pulled);

/// The run of a design of imported bodies with the states that its drive leads through: closed ones and, where the plan says so,
/// the equilibrium of its elastic hinges. Its drive names the hinge that is turned from then on.
/// @throws InvalidInput for a drive that turns a hinge which cannot turn at rest; in equilibrium for bodies that are pulled, and for
/// hinges without an axis
Run with_closed_way(Run run, const RunOptions& options);

/// The run with the convex pieces by which its bodies collide: those of the options where they fit. @pre of imported bodies
Run with_pieces(Run run, const RunOptions& options);

}  // namespace kinetix::app
