#pragma once

#include "app/console/console.hpp"

namespace kinetix::app {

/// Options of `kinetix-opt view`, in addition to those of all commands.
struct ViewRequest {
  std::string source;         ///< a design, a target, or the folder of a result; empty: a template
  bool opens_browser = true;  ///< in the browser
  int port = 0;               ///< 0: any free port
};

/// Runs the studio (`kinetix-opt view DIR
/// DESIGN.yaml
/// TARGET.yaml`) until it is interrupted.
/// @return the exit code. @throws InvalidInput for a source that cannot be read, or a program built without
/// the studio
int view_command(const CommandOptions& options, const ViewRequest& request);

}  // namespace kinetix::app
