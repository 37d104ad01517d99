#pragma once

#include <optional>

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

/// Sets of triangles that are connected by edges with a bend of one sign, or none.
struct BentRegions {
  Facets facets;
  std::vector<std::vector<int>> convex, hollow;
};
BentRegions bent_regions(const Polyhedron& solid);

/// Fits a face to each region. @param fit takes a region, the solid, its facets and whether the region is hollow, and
/// returns an optional face
template <class Face, class Fit>
std::vector<Face> fit_faces(const Polyhedron& solid, const BentRegions& regions, const Fit& fit) {
  std::vector<Face> out;
  for (const bool hollow : {false, true})
    for (const std::vector<int>& region : hollow ? regions.hollow : regions.convex)
      if (const auto face = fit(region, solid, regions.facets, hollow)) out.push_back(*face);
  return out;
}

/// Returns the angle covered about a center: 2 pi minus the largest gap between neighbouring corners, rad.
double covered(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& center);

/// Facets of a solid that are on one round cylinder.
struct CylinderFace {
  bool hollow = false;      ///< true: a bore; false: the outside of a rod
  Eigen::Vector3d point;    ///< on the axis, mm
  Eigen::Vector3d axis;     ///< unit vector; its largest component is positive
  double radius_mm = 0;     ///< radius of the circle through the corners of its facets, mm
  double inner_mm = 0;      ///< distance of the middle of its facets from the axis, mm
  double from = 0, to = 0;  ///< range of axis . p, mm
  double turn = 0;          ///< angle covered by the facets, rad, (0, 2 pi]
};

/// Finds all cylinder faces with at least six facets and more than 200 degrees; a smaller angle does not retain a
/// rod. Neighbouring facets share an edge along the axis, where the surface turns by up to 35 degrees. Circles
/// therefore need 12 sides or more.
std::vector<CylinderFace> cylinder_faces(const Polyhedron& solid, const BentRegions& regions);

/// A rod of one body in the bore of another.
struct PinFit {
  Eigen::Vector3d point;    ///< on the axis, in the middle of the overlap along it, mm
  Eigen::Vector3d axis;     ///< unit vector
  double rod_mm = 0;        ///< diameter, mm
  double clearance_mm = 0;  ///< clearance per side, from the rod's corners to the bore's facets, mm
  double length_mm = 0;     ///< length of the overlap along the axis, mm
};

/// Returns the fit of a rod in a bore if they turn about one axis. Their axes are parallel to 1 degree and nearer
/// than the clearance. The clearance is at most half the rod's radius. Their overlap along the axis is at least a
/// quarter of the rod's diameter.
std::optional<PinFit> pin_fit(const CylinderFace& rod, const CylinderFace& bore);

}  // namespace kinetix::model
