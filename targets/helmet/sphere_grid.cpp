#include "targets/helmet/sphere_grid.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace kinetix::targets {
namespace {

/// The edge of the unit icosahedron is shorter than the distance of any two vertices that are no neighbours.
TriangleMesh icosahedron() {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-std::numbers::phi, std::numbers::phi}) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        mesh.vertices.push_back(p.normalized());
      }
  const auto touch = [&](int i, int j) { return (mesh.vertices[i] - mesh.vertices[j]).norm() < 1.1; };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k) {
        if (!touch(i, j) || !touch(j, k) || !touch(k, i)) continue;
        mesh.triangles.push_back({i, j, k});
        const bool is_inward = area_normal(mesh, mesh.triangles.size() - 1).dot(mesh.vertices[i]) < 0;
        if (is_inward) std::swap(mesh.triangles.back()[1], mesh.triangles.back()[2]);
      }
  return mesh;
}

TriangleMesh finer(const TriangleMesh& mesh) {
  TriangleMesh out{mesh.vertices, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(out.vertices.size()));
    if (is_new) out.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
    return it->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      out.triangles.push_back(t);
  }
  return out;
}

}  // namespace

TriangleMesh sphere_grid(int levels) {
  TriangleMesh mesh = icosahedron();
  for (int level = 0; level < levels; ++level) mesh = finer(mesh);
  return mesh;
}

}  // namespace kinetix::targets
