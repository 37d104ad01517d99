#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Analyses print tolerances of the panel in its equilibrium: to first order, and with sampled prints that are solved
/// for their equilibrium.
/// @return the analysis, or nullopt with the reason: a grey picture, a large panel or no stable equilibrium
std::pair<std::optional<PrintedDisplay>, std::string> display_prints(const DisplayFile& file, const Run& run,
                                                                     const RunOptions& options);

}  // namespace kinetix::app
