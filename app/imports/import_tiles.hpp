#pragma once

#include "app/console/command_options.hpp"
#include "app/imports/import_request.hpp"

namespace kinetix::app {

/// `import` of a folder of tiles: a design of prisms and their joints, pulled to its target, or apart where it has none.
/// @return the exit code   @throws InvalidInput for files, tiles and joints that cannot be, and for options of other models
int import_tiles(const CommandOptions& options, const ImportRequest& request);

}  // namespace kinetix::app
