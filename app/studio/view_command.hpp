#pragma once

#include "app/console/console.hpp"

namespace kinetix::app {

/// What `kinetix-opt view` is asked for, besides what every command is.
struct ViewRequest {
  std::string source;      ///< a design, a target, or the folder of a result; empty: a template
  bool opens_page = true;  ///< in the browser
  int port = 0;            ///< 0: any that is free
};

/// `kinetix-opt view DIR|DESIGN.yaml|TARGET.yaml`: the studio, until it is interrupted.
/// @return the exit code. @throws InvalidInput for a source that cannot be read, or a program built without the studio
int view_command(const CommandOptions& options, const ViewRequest& request);

}  // namespace kinetix::app
