#pragma once

#include "app/console/command_options.hpp"
#include "app/files/design_file.hpp"
#include "app/print/print_request.hpp"
#include "model/base/progress.hpp"

namespace kinetix::app {

/// `kinetix-opt export DESIGN.yaml|DIR --format NAME`: files for slicers, CAD and simulators, all of them or none.
/// @return the exit code. @throws InvalidInput for what cannot be made, or not by the process
int export_command(const CommandOptions& options, const PrintRequest& request);

/// What an export has written.
struct Exported {
  std::string folder;
  std::vector<std::string> files;  ///< names in the folder
  std::string json, text;          ///< print.json and print.txt
  std::string report = {};         ///< of the design's result, which now has the slicer's time; empty: none
};

/// The same of a design in memory. @param folder for the files
Exported export_design(const Design& design, const PrintRequest& request, const std::string& folder,
                       const Progress& progress = {});

/// What the help says of --format.
std::string format_help();

}  // namespace kinetix::app
