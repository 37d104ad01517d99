#pragma once

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::targets {

/// Narrow place of a sheet between the tip of a cut and another cut, the outline, or the same cut farther on.
struct SheetBridge {
  Eigen::Vector2d from, to;  ///< tip and the nearest point ahead of it, in the unit of the graph

  double gap() const { return (to - from).norm(); }
};

/// Finds the bridges between cuts. A tip is an open end, or a corner, crossbar or round end whose cut stays behind it.
/// The bridge of an open end reaches to the nearest point within 75 degrees of the direction of its cut.
/// @param cuts graph of all cuts and the outline   @param widest largest gap of a bridge, > 0.
/// @param is_rim for each edge, whether it is on the outline, which has no tips.
/// @param ends_in_crease for each vertex, whether a crease begins there, so that it needs no bridge
/// @throws InvalidInput without a place for drawings with too many lines near each other
std::vector<SheetBridge> find_bridges(const model::PlanarGraph& cuts, double widest,
                                      const std::vector<bool>& is_rim,
                                      const std::vector<bool>& ends_in_crease);

}  // namespace kinetix::targets
