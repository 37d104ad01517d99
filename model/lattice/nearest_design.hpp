#pragma once

#include <optional>
#include <vector>

#include "model/lattice/lattice.hpp"

namespace kinetix::model {

/// A design of the same cells that moves exactly, and what it changes.
struct NearestDesign {
  Lattice sheet;
  std::vector<int> changed;  ///< hinges, ascending: they break the rule
};

/// Of some exact designs that are near the one that changes hinges least (sum of squares, of tilts and angles in rad, of
/// t and offsets in cell edges): every crease with one tilt, the middle one of its walls; the creases along x alone, or
/// along y alone; on upright hinges the places that close every cell; on other lattices than squares those that close every
/// cell and keep every crease straight. The sheet itself where it moves exactly.
/// @return nothing where none of these does
std::optional<NearestDesign> nearest_design(const Lattice& sheet);

}  // namespace kinetix::model
