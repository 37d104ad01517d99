#pragma once

#include <string>
#include <vector>

#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

/// The same triangles with one point for each set of points within `tolerance` of each other along x, y and z (of one cell
/// of a grid that wide; 0: of equal ones), in the order of their first use. Triangles that lose an edge by it are left out.
/// @param tolerance mm, >= 0
Polyhedron welded(const Polyhedron& soup, double tolerance);

/// The pieces of a welded soup that hang together by edges, each with its own points, in the order of their first triangle.
/// An edge of more than two triangles joins those that run through it in opposite directions and follow each other in the
/// list, so that solids that touch along an edge stay apart where a file has one after the other.
std::vector<Polyhedron> shells(const Polyhedron& soup);

/// What keeps a shell from being a solid: "is empty", "is open: ...", "is inside out: ..."; empty for a solid.
/// With the place of the first edge, mm.
std::string shell_defect(const Polyhedron& shell);

}  // namespace kinetix::model
