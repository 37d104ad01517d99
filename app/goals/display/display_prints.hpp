#pragma once

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// What prints of the panel show, in its equilibrium: to first order, and in so many prints at least that are brought
/// to their own. @param run whose prints_unknown says why there is nothing: of grey pictures, of panels that are too
/// large, and without a stable equilibrium
std::optional<PrintedDisplay> display_prints(const DisplayFile& file, Run& run, const RunOptions& options);

}  // namespace kinetix::app
