#pragma once

#include "model/solids/polyhedron.hpp"

namespace kinetix::testing {

/// Least distance of two surfaces that do not cross, mm, triangle by triangle: of corners and faces, and of edges.
double surface_distance(const model::Polyhedron& a, const model::Polyhedron& b);

/// Whether an edge of one goes through a face of the other.
bool surfaces_cross(const model::Polyhedron& a, const model::Polyhedron& b);

/// What of a flat quadrilateral lies on faces of a solid that look the other way, by 40 x 40 points of it. @return 0 to 1
double covered_share(const std::array<Eigen::Vector3d, 4>& corners, const model::Polyhedron& solid);

}  // namespace kinetix::testing
