#pragma once

#include <optional>
#include <string>

#include "app/run/run.hpp"

namespace kinetix::app {

/// What `export` without options answers to a run's design: pins where they fit, else blocks, and hinges that the file
/// describes as it does. Tried with the same solids along the same way to the fold.
PrintAnswer answer_of_export(const Run& run);

}  // namespace kinetix::app
