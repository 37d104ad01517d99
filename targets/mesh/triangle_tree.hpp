#pragma once

#include <optional>

#include "model/base/box.hpp"
#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Whether a triangle, which may lack area, lies in a box, wholly or in part; touching counts. All in mm.
bool is_in_box(const std::array<Eigen::Vector3d, 3>& corners, const OrientedBox& box);

/// Place of a mesh nearest to a point.
struct NearestPlace {
  int triangle = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< mm
  double squared_distance = 0;                      ///< from the point, mm^2
};

/// Returns the nearest place on a triangle, which may lack area, mm.
Eigen::Vector3d nearest_on_triangle(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& p);

/// Tree of boxes over the triangles of a mesh in any condition. Points in mm. Queries take O(log triangles) and may
/// run in parallel; the same query gives the same answer.
class TriangleTree {
 public:
  /// @pre at least one triangle
  explicit TriangleTree(const TriangleMesh& mesh);

  NearestPlace nearest(const Eigen::Vector3d& p) const;
  /// Returns the distance, in lengths of `direction`, to the last place where a ray leaves the mesh; empty if it meets
  /// none. Rays that hit an edge hit the mesh.
  std::optional<double> farthest_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  /// Whether a ray meets the mesh.
  bool is_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  /// Whether a triangle lies in a box, wholly or in part.
  bool touches(const OrientedBox& box) const;

  /// A box of the tree. Children come after their parent.
  struct Branch {
    Eigen::AlignedBox3d box;
    int first = 0, count = 0;  ///< of leaves(); count 0: children at this + 1 and at `second`
    int second = 0;
  };
  /// A triangle of the mesh.
  struct Leaf {
    std::array<Eigen::Vector3d, 3> corners;
    int triangle = 0;
    bool lacks_area = false;
  };
  /// For sums over the mesh (winding_number.hpp). The root is the first.
  const std::vector<Branch>& branches() const { return branches_; }
  const std::vector<Leaf>& leaves() const { return leaves_; }

 private:
  void build(std::vector<Eigen::Vector3d>& centres, std::vector<int>& order, int first, int count,
             const TriangleMesh& mesh);

  std::vector<Branch> branches_;
  std::vector<Leaf> leaves_;
};

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
