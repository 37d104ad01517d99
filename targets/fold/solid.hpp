#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace kinetix::targets {

/// A convex solid whose edges all have length 1.
struct Solid {
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::vector<int>> faces;  ///< corners of each, counter-clockwise as seen from inside
};

/// "tetrahedron", "octahedron", "icosahedron", "dodecahedron", "triangular_prism" (a box with triangular lids) and
/// "square_pyramid".
const std::vector<std::string>& solid_names();
/// @param index in solid_names()
Solid named_solid(int index);

/// The convex hull of corners that are at least 1 apart, as a solid. Edges are what joins corners of two faces.
/// @pre no corner lies inside the hull of the others
Solid hull_of(std::vector<Eigen::Vector3d> corners);

/// Edge that two faces share. It is side `first_side` of the first (from its corner of that number to the next), and
/// `second_side` of the second.
struct SolidEdge {
  int first = 0, first_side = 0, second = 0, second_side = 0;
  double turn = 0;  ///< rad: 180 deg less the angle between the faces inside
};
std::vector<SolidEdge> edges_of(const Solid& solid);

}  // namespace kinetix::targets
