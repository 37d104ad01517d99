#pragma once

#include "app/console/command_options.hpp"
#include "app/print/print_request.hpp"

namespace kinetix::app {

/// `kinetix-opt export DESIGN.yaml|DIR --format NAME`: files for slicers, CAD and simulators, all of them or none.
/// @return the exit code. @throws InvalidInput for what cannot be made, or not by the process
int export_command(const CommandOptions& options, const PrintRequest& request);

/// What the help says of --format.
std::string format_help();

}  // namespace kinetix::app
