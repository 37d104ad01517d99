#pragma once

#include "app/print/print_format.hpp"

namespace kinetix::app {

/// all.stl, hard.stl and, of blocks and films, soft.stl: binary, mm, in common coordinates.
extern const PrintFormat stl_format;

}  // namespace kinetix::app
