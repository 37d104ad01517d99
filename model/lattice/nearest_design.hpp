#pragma once

#include "model/lattice/lattice.hpp"

namespace kinetix::model {

/// A design of the same cells that moves exactly, and its changes.
struct NearestDesign {
  Lattice sheet;
  std::vector<int> changed;  ///< hinges that break the rule, ascending
};

/// Returns the nearest of several exact designs, by the sum of squared changes of the hinges. Tilts and angles are in
/// rad, t and offsets in cell edges. The candidates are:
/// - Every crease of squares has one tilt, the median of its walls. Creases along x, along y or both are tilted.
/// - All hinges are upright, at the positions that close every cell.
/// - On lattices other than squares, hinges are at positions that close every cell and keep every crease straight.
///
/// A sheet that moves exactly is returned unchanged.
/// @return empty if no candidate moves exactly
std::optional<NearestDesign> nearest_design(const Lattice& sheet);

}  // namespace kinetix::model
