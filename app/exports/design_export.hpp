#pragma once

#include "app/exports/exporter.hpp"

namespace kinetix::app {

/// design.yaml: the structure with all its parameters, as verify and simulate read it.
extern const Exporter design_export;

}  // namespace kinetix::app
