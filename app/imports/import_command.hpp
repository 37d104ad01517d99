#pragma once

#include "app/console/console.hpp"
#include "app/imports/import_request.hpp"

namespace kinetix::app {

/// Runs `kinetix-opt import MODEL|--hard A --soft B -o DIR`: makes a design of general bodies from a 3D model. Writes
/// design.yaml and its part files, all of them or none. @return the exit code. @throws InvalidInput for unusable
/// models
int import_command(const CommandOptions& options, const ImportRequest& request);

}  // namespace kinetix::app
