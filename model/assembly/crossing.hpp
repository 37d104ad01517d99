#pragma once

#include <Eigen/Core>
#include <optional>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Finds a place where an edge of one solid crosses a triangle of the other. Touching does not count: both ends must
/// be off the triangle's plane by more than `depth`, and the place inside the triangle by as much.
/// @param depth mm, > 0   @return the place, mm
std::optional<Eigen::Vector3d> crossing(const Polyhedron& a, const Polyhedron& b, double depth);
/// Finds a crossing of triangles within one shell; triangles that share a point do not count.
std::optional<Eigen::Vector3d> self_crossing(const Polyhedron& shell, double depth);

/// Returns true if a point is inside a closed solid, by the parity of crossings of a ray.
bool is_inside(const Polyhedron& solid, const Eigen::Vector3d& p);

}  // namespace kinetix::model
