#pragma once

#include <cmath>

#include "targets/mesh_distance.hpp"

namespace kinetix::testing {

/// An ellipsoid about the origin, half axes in mm, of rings x 2 rings quadrilaterals.
inline TriangleMesh ellipsoid(const Eigen::Vector3d& axes, int rings) {
  TriangleMesh mesh;
  const int around = 2 * rings;
  for (int r = 0; r <= rings; ++r)
    for (int k = 0; k < around; ++k) {
      const double down = pi * r / rings, turn = 2 * pi * k / around;
      const Eigen::Vector3d unit(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn),
                                 std::cos(down));
      mesh.vertices.push_back(axes.cwiseProduct(unit));
    }
  const auto at = [&](int r, int k) { return r * around + k % around; };
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < around; ++k) {
      mesh.triangles.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
      mesh.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
    }
  return joined(mesh);
}

}  // namespace kinetix::testing
