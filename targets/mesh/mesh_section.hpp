#pragma once

#include <vector>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

using Plane = Eigen::Hyperplane<double, 3>;

/// One line of the section of a mesh by a plane.
struct SectionChain {
  std::vector<Eigen::Vector3d> points;  ///< mm, at least two; a closed chain does not repeat its first
  bool is_closed = false;
};

/// The section of a mesh by a plane, in mm. Chains run through triangles that share vertices
/// (triangle_mesh.hpp: joined) and end at holes and where more than two sheets meet. A vertex on the plane
/// counts as above it, so that triangles in the plane give nothing and triangles doubled or without area do
/// no harm.
std::vector<SectionChain> section(const TriangleMesh& mesh, const Plane& plane);

}  // namespace kinetix::targets
