#pragma once

#include "model/lattice/lattice.hpp"

namespace kinetix::model {

/// A hinge of a sheet at rest, as its linkage has it.
RestHinge rest_hinge(const Lattice& sheet, int hinge);

}  // namespace kinetix::model
