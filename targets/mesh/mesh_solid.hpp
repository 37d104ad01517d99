#pragma once

#include "targets/mesh/winding_number.hpp"

namespace kinetix::targets {

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
