#pragma once

#include <string>
#include <vector>

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

}  // namespace kinetix::model
