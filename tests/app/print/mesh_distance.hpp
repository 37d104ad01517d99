#pragma once

#include "model/solids/polyhedron.hpp"

namespace kinetix::testing {

/// Computes the least distance of two surfaces that do not cross, mm: over all corners and faces, and over all edges.
double surface_distance(const model::Polyhedron& a, const model::Polyhedron& b);

/// Checks whether an edge of one surface crosses a face of the other.
bool surfaces_cross(const model::Polyhedron& a, const model::Polyhedron& b);

/// Computes the share of a flat quadrilateral that is on opposite faces of a solid, from 40 x 40 points.
/// @return 0 to 1
double covered_share(const std::array<Eigen::Vector3d, 4>& corners, const model::Polyhedron& solid);

}  // namespace kinetix::testing
