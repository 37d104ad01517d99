#pragma once

#include "optim/outline/outline_problem.hpp"

namespace kinetix::optim {

/// Returns the shape of a panel that deforms as another one with larger cells. Both panels at rest are laid over each
/// other, stretched to one bounding box. Places between vertices are interpolated linearly in triangles from the middle
/// of each cell to its walls.
/// @param coarse, fine panels at rest, cut from a lattice   @param shape of the coarse one
OutlineShape refined_shape(const model::PlanarStructure& coarse, const OutlineShape& shape,
                           const model::PlanarStructure& fine);

}  // namespace kinetix::optim
