#pragma once

#include "targets/mesh/triangle_tree.hpp"

namespace kinetix::targets {

/// The place of a mesh nearest to a point p, and on which side of it p is.
struct ClosestMeshPoint {
  int triangle = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< mm
  double distance = 0;                              ///< from the point, mm; < 0 on the inner side
  /// Gradient of the distance with respect to p: a unit vector, outward. Off the mesh it is the direction
  /// from closest point to p (or back), on it the normal of the triangle.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  /// Unit normal of the triangle, outward. Far from `normal` where the closest point is on the rim of a
  /// hole or on a sharp edge.
  Eigen::Vector3d face_normal = Eigen::Vector3d::UnitZ();
};

/// Distance from a mesh whose outer side is the one that faces away from one inner point: true for what that
/// point sees from inside, such as the top of a head, however its triangles are wound.
class MeshDistance {
 public:
  /// @param inside a point inside, mm @pre at least one triangle
  MeshDistance(TriangleMesh mesh, const Eigen::Vector3d& inside);

  /// @param p mm
  ClosestMeshPoint closest(const Eigen::Vector3d& p) const;
  const TriangleMesh& mesh() const { return mesh_; }
  const TriangleTree& tree() const { return tree_; }
  const Eigen::Vector3d& inside() const { return inside_; }

 private:
  TriangleMesh mesh_;
  TriangleTree tree_;
  Eigen::Vector3d inside_;
};

}  // namespace kinetix::targets
