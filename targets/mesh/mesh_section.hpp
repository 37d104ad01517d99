#pragma once

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

using Plane = Eigen::Hyperplane<double, 3>;

/// Line of the section of a mesh by a plane.
struct SectionChain {
  std::vector<Eigen::Vector3d> points;  ///< mm, at least two; a closed chain does not repeat its first
  bool is_closed = false;
};

/// Computes the section of a mesh by a plane, in mm. Chains run through triangles that share vertices
/// (triangle_mesh.hpp: joined). They end at holes, and at edges of more than two sheets. A vertex on the plane counts
/// as above it, so triangles in the plane give nothing. Triangles doubled or without area do no harm.
std::vector<SectionChain> section(const TriangleMesh& mesh, const Plane& plane);

}  // namespace kinetix::targets
