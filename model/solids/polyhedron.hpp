#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace kinetix::model {

/// A solid by its surface: triangles whose corners run counter-clockwise seen from outside. mm
struct Polyhedron {
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::array<int, 3>> triangles = {};

  /// Adds a flat convex polygon, as triangles from its first corner. @param corners counter-clockwise from outside;
  /// some may lie between two others on one line, if the first is not on that line
  void add_face(const std::vector<int>& corners);
  int add_point(const Eigen::Vector3d& point);
};

/// Whether each edge belongs to two triangles that run through it in opposite directions, and none is a point.
bool is_closed(const Polyhedron& solid);

/// The same solid elsewhere in the same list of triangles. @pre room for its indices
void append(const Polyhedron& part, Polyhedron& whole);

/// Of a solid of density 1, by the divergence theorem over its triangles: exact for the triangles as they are.
struct MassProperties {
  double volume_mm3 = 0;                              ///< in mm^3
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< mm
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the center, mm^5
};
/// @pre closed
MassProperties mass_properties(const Polyhedron& solid);
double volume_mm3(const Polyhedron& solid);

}  // namespace kinetix::model
