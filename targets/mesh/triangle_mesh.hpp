#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace kinetix::targets {

using Triangle = std::array<int, 3>;

/// A triangle soup over shared vertices, mm. Nothing is promised about it but that indices are in range and
/// coordinates finite: it may have holes, several shells, triangles without area or listed twice, edges that
/// more than two triangles share, and triangles wound either way.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;

  const Eigen::Vector3d& corner(std::size_t triangle, int k) const {
    return vertices[triangles[triangle][k]];
  }
  Eigen::AlignedBox3d box_of(std::size_t triangle) const {
    return Eigen::AlignedBox3d(corner(triangle, 0)).extend(corner(triangle, 1)).extend(corner(triangle, 2));
  }
};

/// Normal of a triangle as it is wound, its length twice the area, mm^2.
inline Eigen::Vector3d area_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const Eigen::Vector3d &a = mesh.corner(triangle, 0), &b = mesh.corner(triangle, 1);
  return (b - a).cross(mesh.corner(triangle, 2) - a);
}

/// Box of the vertices that triangles use, mm.
Eigen::AlignedBox3d bounds(const TriangleMesh& mesh);

/// The same triangles with one vertex for each set of equal coordinates, in the order of their first use, and
/// without vertices that no triangle uses.
TriangleMesh joined(const TriangleMesh& mesh);

}  // namespace kinetix::targets
