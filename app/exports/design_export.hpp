#pragma once

#include "app/exports/exporter.hpp"
#include "app/files/design_file.hpp"

namespace kinetix::app {

/// design.yaml: the structure with all its parameters, as verify and simulate read it.
extern const Exporter design_export;

/// The same before it is text.
DesignFile written_design(const Run& run);

}  // namespace kinetix::app
