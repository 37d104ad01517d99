#pragma once

#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// Describes how a path stopped, for people. result.json has `torn` for an overstretched hinge.
std::string in_words(model::EquilibriumPath::Stop stop);

/// Describes that a sheet folded to the opposite side. @param theta that it reached, rad
std::string describe_other_side(const Equilibrium& equilibrium, double theta);

/// Describes why an equilibrium is not the goal of its drive. @param theta that it reached, rad
/// @pre its path stopped early, or the sheet is on the opposite side
std::string missed_words(const Equilibrium& equilibrium, double theta);

/// Describes where and why the drive stops before its goal, one sentence. @pre it did
std::string drive_stop_reason(const model::EquilibriumPath& path);

}  // namespace kinetix::app
