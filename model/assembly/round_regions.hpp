#pragma once

#include "model/base/geometry.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::model {

// Rad: a bore of little more than half a turn does not retain a rod
inline constexpr double min_round_turn = 200 * radians_per_degree;
inline constexpr int min_round_facets = 6;      // facets in 200 degrees of twelve sides, minus one
inline constexpr double roundness = 2e-3;       // tolerance of corners on a round face, ratio to the radius
inline constexpr double flattest_facet = 0.95;  // ratio to the radius, below cos(pi / 12) of twelve sides
inline constexpr double parallel_axes = 1 * radians_per_degree;  // rad, of one hinge: a larger angle jams
inline constexpr double max_bearing_play = 0.5;  // largest clearance, ratio to the rod's radius
inline constexpr double min_bearing_overlap =
    0.25;  // along the axis, ratio to the diameter: less is only a touch

/// Triangles of a solid by their normals and middles.
struct Facets {
  std::vector<Eigen::Vector3d> normals;  ///< unit vectors; zero for triangles without area
  std::vector<Eigen::Vector3d> centers;  ///< mm
};
Facets facets_of(const Polyhedron& solid);

/// Returns the sets of triangles that are connected by edges with a bend of one sign, or none.
/// @param sign 1 for convex faces, -1 for hollow ones
std::vector<std::vector<int>> bent_regions(const Polyhedron& solid, const Facets& facets, double sign);

/// Returns the angle covered about a center: 2 pi minus the largest gap between neighbouring corners, rad.
double covered(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& center);

}  // namespace kinetix::model
