#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace kinetix::targets {

using Triangle = std::array<int, 3>;

/// Triangle soup over shared vertices, mm. Only two properties are guaranteed: indices are in range and coordinates
/// finite. A mesh may have holes, several shells, and edges that more than two triangles share. Triangles may lack
/// area, be listed twice, and be wound either way.
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

/// Returns the normal of a triangle as it is wound; its length is twice the area, mm^2.
inline Eigen::Vector3d area_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const Eigen::Vector3d &a = mesh.corner(triangle, 0), &b = mesh.corner(triangle, 1);
  return (b - a).cross(mesh.corner(triangle, 2) - a);
}

/// Returns the box of the vertices that triangles use, mm.
Eigen::AlignedBox3d bounds(const TriangleMesh& mesh);

/// Returns the mesh with one vertex for each set of equal coordinates, in the order of their first use. Vertices that
/// no triangle uses are left out.
TriangleMesh joined(const TriangleMesh& mesh);

/// Returns the mesh with triangles that run along shared edges in opposite directions, as far as that is possible.
/// Each part keeps the winding of most of its area. Triangles without area are left out.
TriangleMesh wound_alike(const TriangleMesh& mesh);

/// Returns the mesh without parts that float next to it: those farther than about `gap` mm from all others, with less
/// than a tenth of the area of the largest. Vertices in the same or in adjacent bins of that size count as near, so
/// cracks between triangles do not split a mesh. @pre gap > 0
TriangleMesh without_fragments(const TriangleMesh& mesh, double gap);

}  // namespace kinetix::targets
