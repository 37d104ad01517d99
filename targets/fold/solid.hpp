#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// A convex solid whose shortest edge has length 1. All edges of named solids have this length.
struct Solid {
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::vector<int>> faces;  ///< corners of each, counter-clockwise as seen from inside
};

/// "tetrahedron", "octahedron", "icosahedron", "dodecahedron", "triangular_prism" (a box with triangular lids),
/// "square_pyramid" and "cube".
const std::vector<std::string>& solid_names();
/// @param index in solid_names()
Solid named_solid(int index);

/// Returns the convex hull of corners that are at least 1 apart, as a solid. Edges join corners of two faces.
/// @param flat distance of corners from the plane of their face, up to which they belong to it
/// @pre no corner lies inside the hull of the others
Solid hull_of(std::vector<Eigen::Vector3d> corners, double flat = 1e-9);

/// Most corners of a solid from a file. A hull takes time with the fourth power of their number.
inline constexpr std::size_t max_solid_corners = 60;
/// Largest ratio of a solid's longest edge to its shortest: cells on both have the same number.
inline constexpr double max_edge_ratio = 4;

/// Returns the convex solid with the surface of a mesh, in any unit. Triangles in one plane are one face.
/// @throws InvalidInput without a place for a mesh that is open or not convex, and beyond the limits above
Solid solid_of(const TriangleMesh& mesh);

/// Edge that two faces share. It is side `first_side` of the first (from its corner of that number to the next), and
/// `second_side` of the second.
struct SolidEdge {
  int first = 0, first_side = 0, second = 0, second_side = 0;
  double turn = 0;  ///< rad: 180 deg less the angle between the faces inside
};
std::vector<SolidEdge> edges_of(const Solid& solid);

}  // namespace kinetix::targets
