#pragma once

#include "app/run/run.hpp"

namespace kinetix::app {

/// What prints of the run's first state come to, with hinges as stiff as the file says (or by default) and the
/// process's errors: the place of hinges, the tilt of walls, and half of what a pin's clearance leaves open.
/// @param drive that holds the state   @param points by which the goal is judged
/// @param prints so many are brought to their equilibrium as well, to confirm it; a few in any case, but for large sheets
/// @return nothing without points, or where the state is not stable under that drive
std::optional<PrintedGoal> as_made(const Run& run, const model::LinkageDrive& drive,
                                   const std::vector<model::ObservedPoint>& points, int prints);

}  // namespace kinetix::app
