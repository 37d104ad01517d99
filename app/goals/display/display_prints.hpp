#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// What prints of the panel show, in its equilibrium: to first order, and in so many prints at least that are brought
/// to their own.
/// @return or why there is nothing: of grey pictures, of panels that are too large, and without a stable equilibrium
std::pair<std::optional<PrintedDisplay>, std::string> display_prints(const DisplayFile& file, const Run& run,
                                                                     const RunOptions& options);

}  // namespace kinetix::app
