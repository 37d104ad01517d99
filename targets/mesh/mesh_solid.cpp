#include "targets/mesh/mesh_solid.hpp"

#include <cmath>

#include "targets/mesh/outer_skin.hpp"

namespace kinetix::targets {

MeshSolid::MeshSolid(const TriangleMesh& mesh) : skin_(outer_skin(mesh)), winding_(TriangleTree(skin_)) {}

double MeshSolid::distance(const Eigen::Vector3d& p) const {
  const double size = std::sqrt(tree().nearest(p).squared_distance);
  return contains(p) ? -size : size;
}

}  // namespace kinetix::targets
