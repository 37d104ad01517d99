#pragma once

#include "model/sheet/sheet.hpp"

namespace kinetix::model {

/// A hinge of a sheet at rest, as its linkage has it.
RestHinge rest_hinge(const Sheet& sheet, int hinge);

}  // namespace kinetix::model
