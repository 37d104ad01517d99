#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace kinetix::model {

/// A solid defined by its surface: triangles with corners counter-clockwise from outside, mm.
struct Polyhedron {
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::array<int, 3>> triangles = {};

  /// Adds a flat convex polygon, as triangles from its first corner.
  /// @param corners counter-clockwise from outside; some may be between two others on one line, if the first is not
  /// on that line
  void add_face(const std::vector<int>& corners);
  int add_point(const Eigen::Vector3d& point);
};

/// Returns true if each edge belongs to two triangles with opposite directions, and no edge is a point.
bool is_closed(const Polyhedron& solid);

/// Appends a solid to the points and triangles of another. @pre the sum of points fits the index type
void append(const Polyhedron& part, Polyhedron& whole);

/// Volume, center and inertia of a solid of density 1.
struct MassProperties {
  double volume_mm3 = 0;                              ///< in mm^3
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< mm
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the center, mm^5
};
/// Computes them by the divergence theorem over the triangles: exact for the triangles. @pre closed
MassProperties mass_properties(const Polyhedron& solid);
double volume_mm3(const Polyhedron& solid);

/// Convex hull of few points, mm: its corners and its faces.
struct ConvexHull {
  std::vector<Eigen::Vector3d> corners;  ///< mm
  std::vector<std::vector<int>> faces;   ///< corners of each, counter-clockwise from outside
};

/// Computes the hull. Points nearer than 1e-7 mm are one corner, and points this near to a face's plane belong to it.
/// Faces are therefore polygons of any number of points. The method tries every plane through three points, in
/// O(n^4), and is meant for about 20 points.
/// @throws std::logic_error if the points are in one plane
ConvexHull convex_hull(const std::vector<Eigen::Vector3d>& points);

}  // namespace kinetix::model
