#pragma once

#include <map>

#include "app/files/hinge_limits.hpp"
#include "app/run/hinge_loads.hpp"
#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::app {

/// What a path asks of who drives the sheet, and of its hinges. @param own of hinges that are not as the rest
HingeLoads hinge_loads(const model::EquilibriumPath& path, const model::LinkageDrive& drive,
                       const model::Linkage& linkage, const HingeSection& hinge,
                       const std::map<int, HingeSection>& own = {});

/// The largest of all loads over its limit; infinite where there is no equilibrium. Ratio
double share_of(const HingeLimits& limits, const HingeLoads& loads);

/// What of the limits is not kept, in words. @param instead what the search could do to keep it, "less compression"
std::vector<std::string> violations(const HingeLimits& limits, const HingeLoads& loads,
                                    const std::string& instead);

}  // namespace kinetix::app
