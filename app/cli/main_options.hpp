#pragma once

#include <string>

#include "app/cli/main_help.hpp"
#include "app/console/console.hpp"
#include "app/imports/import_command.hpp"
#include "app/print/export_command.hpp"
#include "app/studio/view_command.hpp"

namespace kinetix::app {

/// Values of a parsed command line.
struct CommandLine {
  CommandOptions options = {};
  PrintRequest print = {};
  ImportRequest model = {};
  ViewRequest view = {};
  std::string share = {};  ///< of sweep: K/N
};

/// Adds all options and commands. @param line filled by parsing; lives as long as the app
void add_options(CLI::App& app, CommandLine& line);

}  // namespace kinetix::app
