#pragma once

#include "app/exports/exporter.hpp"

namespace kinetix::app {

/// Pictures of the goal, where its kind has any.
extern const Exporter pictures_export;

}  // namespace kinetix::app
