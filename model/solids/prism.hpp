#pragma once

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Corners of a closed line in the plane, in order.
using FlatRing = std::vector<Eigen::Vector2d>;

/// Creates the upright prism of a flat shape, closed and with a corner for each corner of its rings.
/// @param rings the outline counter-clockwise, then holes clockwise, mm. They neither cross nor touch each other
/// @param bottom, top heights, bottom < top, mm
Polyhedron make_prism(const std::vector<FlatRing>& rings, double bottom, double top);

}  // namespace kinetix::model
