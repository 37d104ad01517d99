#pragma once

#include "targets/mesh/triangle_tree.hpp"

namespace kinetix::targets {

/// Place of a mesh nearest to a point p, and the side of it on which p is.
struct ClosestMeshPoint {
  int triangle = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< mm
  double distance = 0;                              ///< from the point, mm; < 0 on the inner side
  /// Gradient of the distance with respect to p: a unit vector, outward. Off the mesh it is the direction
  /// from closest point to p (or back), on it the normal of the triangle.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  /// Unit normal of the triangle, outward. It differs from `normal` if the closest point is on the edge of a hole or
  /// on a sharp edge.
  Eigen::Vector3d face_normal = Eigen::Vector3d::UnitZ();
};

/// Distance from a mesh whose outer side faces away from one inner point, however its triangles are wound. This is
/// true for the parts that the point sees from inside, such as the top of a head.
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
