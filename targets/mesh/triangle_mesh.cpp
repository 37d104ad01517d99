#include "targets/mesh/triangle_mesh.hpp"

#include <algorithm>
#include <numeric>

namespace kinetix::targets {
namespace {

/// For each vertex, the least index of those at its place.
std::vector<int> first_alike(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<int> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) { return std::tuple(vertices[v].x(), vertices[v].y(), vertices[v].z()); };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];
  return first;
}

}  // namespace

Eigen::AlignedBox3d bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) box.extend(mesh.box_of(t));
  return box;
}

TriangleMesh joined(const TriangleMesh& mesh) {
  const std::vector<int> first = first_alike(mesh.vertices);
  std::vector<int> renamed(mesh.vertices.size(), -1);
  TriangleMesh out;
  out.triangles.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    Triangle& corners = out.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      int& name = renamed[first[triangle[k]]];
      if (name < 0) {
        name = static_cast<int>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[triangle[k]]);
      }
      corners[k] = name;
    }
  }
  return out;
}

}  // namespace kinetix::targets
