#pragma once

#include <Eigen/Core>
#include <optional>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Where an edge of one solid goes through a triangle of the other, or of the same one. Touching is none: both ends must be
/// off the triangle's plane by more than `depth`, and the place inside the triangle by as much.
/// @param depth mm, > 0   @return the place, mm
std::optional<Eigen::Vector3d> crossing(const Polyhedron& a, const Polyhedron& b, double depth);
/// Likewise within one shell; triangles that share a point do not count.
std::optional<Eigen::Vector3d> self_crossing(const Polyhedron& shell, double depth);

/// Whether a point is inside a closed solid: by the parity of a ray in an odd direction.
bool is_inside(const Polyhedron& solid, const Eigen::Vector3d& p);

}  // namespace kinetix::model
