#pragma once

#include "targets/mesh/triangle_mesh.hpp"
#include "targets/mesh/triangle_tree.hpp"

namespace kinetix::targets {

/// Returns the triangles that are visible from outside, each once and all wound outward, so that a winding number
/// separates inside from outside. Triangles that share an edge with only one other are turned consistently. Each patch
/// of them is turned to the side from which more rays leave the mesh (Takayama et al. 2014). Patches that no ray
/// leaves, such as inner shells, are left out, as are triangles listed twice or without area. The order of the rest is
/// kept. A mesh of which nothing else is left stays as it is.
/// @param mesh with equal vertices joined (triangle_mesh.hpp)
TriangleMesh outer_skin(const TriangleMesh& mesh);

/// Computes the solid angle of a triangle as seen from p (both in mm), sr, in [-2 pi, 2 pi]. It is > 0 if p is behind
/// the triangle as it is wound, and 0 at its corners. (van Oosterom and Strackee 1983)
double solid_angle(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& p);

/// Generalised winding number of a mesh: how often it goes round a point, 1 inside and 0 outside of a closed mesh that
/// is wound outward. At holes it changes smoothly from one to the other. It is 1/2 on a surface that closes the holes,
/// which for a plane edge is its plane. (Jacobson, Kavan, Sorkine-Hornung 2013)
///
/// Triangles near the point are summed one by one. Branches of the tree farther than three of their radii use the
/// first two terms of their series (Barill et al. 2018). The error is 0.04 in the middle of a sphere and less near the
/// mesh, small enough to separate a value from 1/2.
class WindingNumber {
 public:
  explicit WindingNumber(TriangleTree tree);

  /// @param p mm
  double at(const Eigen::Vector3d& p) const;
  const TriangleTree& tree() const { return tree_; }

 private:
  /// Moments of the triangles below a branch: sums over their area vectors a (half of area_normal), mm^2.
  struct Moments {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< mean of their centroids by area, mm
    Eigen::Vector3d area = Eigen::Vector3d::Zero();    ///< sum of a
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< sum of a (centroid - center)^T, mm^3
    double radius = 0;                                 ///< of all corners about the center, mm
    int end = 0;                                       ///< of the leaves below
  };

  Moments moments_of(int first, int end) const;
  double angle_below(int branch, const Eigen::Vector3d& p) const;

  TriangleTree tree_;
  std::vector<Moments> moments_;  // of each branch
};

/// Solid that a mesh encloses, however its triangles are wound: the points where the winding number of its outer skin
/// (outer_skin.hpp) is over 1/2. Thin parts and hollows are distinguished from their surroundings. Holes are closed
/// smoothly.
class MeshSolid {
 public:
  /// @param mesh with equal vertices joined @pre at least one triangle
  explicit MeshSolid(const TriangleMesh& mesh);

  /// @param p mm
  bool contains(const Eigen::Vector3d& p) const { return winding_.at(p) > 0.5; }
  /// Returns the distance from the skin, mm, < 0 inside. Over holes it is the distance from their edges.
  double distance(const Eigen::Vector3d& p) const;

  const TriangleMesh& skin() const { return skin_; }
  const TriangleTree& tree() const { return winding_.tree(); }

 private:
  TriangleMesh skin_;
  WindingNumber winding_;
};

}  // namespace kinetix::targets
