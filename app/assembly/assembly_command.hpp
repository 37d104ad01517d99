#pragma once

#include "app/console/command_options.hpp"
#include "app/run/plan.hpp"
#include "targets/document/document.hpp"

namespace kinetix::app {

/// `simulate` and `verify` of a design of general bodies: result.json, design.yaml and its parts in the folder.
/// @return the exit code
int run_assembly_command(const CommandOptions& options, const targets::Node& root, Model model,
                         const std::string& suffix);

}  // namespace kinetix::app
