#pragma once

#include <optional>
#include <string>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// Returns the triangles with one point for each set of near points, in the order of their first use. Points are near
/// if they are in one cell of a grid of width `tolerance`, or equal for 0. Triangles that lose an edge are omitted.
/// @param tolerance mm, >= 0
Polyhedron welded(const Polyhedron& soup, double tolerance);

/// Returns the pieces of a welded soup that are connected by edges, each with its points, in the order of their first
/// triangle. An edge of more than two triangles joins those that traverse it in opposite directions and are next to
/// each other in the list. Solids that touch along an edge therefore stay separate if a file lists one after the
/// other.
std::vector<Polyhedron> shells(const Polyhedron& soup);

/// Describes why a shell is not a solid: "is empty", "is open: ...", "is inside out: ...". Empty for a solid. It
/// includes the place of the first such edge, mm.
std::string shell_defect(const Polyhedron& shell);

/// Finds a place where an edge of one solid crosses a triangle of the other. Touching does not count: both ends must
/// be off the triangle's plane by more than `depth`, and the place inside the triangle by as much.
/// @param depth mm, > 0   @return the place, mm
std::optional<Eigen::Vector3d> crossing(const Polyhedron& a, const Polyhedron& b, double depth);
/// Finds a crossing of triangles within one shell; triangles that share a point do not count.
std::optional<Eigen::Vector3d> self_crossing(const Polyhedron& shell, double depth);

/// Returns true if a point is inside a closed solid, by the parity of crossings of a ray.
bool is_inside(const Polyhedron& solid, const Eigen::Vector3d& p);

}  // namespace kinetix::model
