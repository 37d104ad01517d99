#pragma once

#include "model/lattice/lattice.hpp"

namespace kinetix::model {

/// Returns a hinge of a sheet at rest, as in its linkage.
RestHinge rest_hinge(const Lattice& sheet, int hinge);

}  // namespace kinetix::model
