#pragma once

#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// How a path stopped, for people: result.json says `torn` where a hinge was overstretched.
std::string in_words(model::EquilibriumPath::Stop stop);

/// That a sheet folded to the other side than asked. @param theta that it came to, rad
std::string describe_other_side(const Equilibrium& equilibrium, double theta);

/// Why an equilibrium is not what its drive was to lead to. @param theta that it came to, rad   @pre it stopped, or is on the
/// other side
std::string missed_words(const Equilibrium& equilibrium, double theta);

/// That the drive stops on its way, and why, one sentence. @pre it did
std::string drive_stop_reason(const model::EquilibriumPath& path);

}  // namespace kinetix::app
