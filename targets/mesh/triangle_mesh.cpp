#include "targets/mesh/triangle_mesh.hpp"

#include <map>

#include "model/base/algorithms.hpp"

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

namespace {

// Least area of a part that is kept, as a fraction of the area of the largest part. Smaller ones that float next to it
// are noise of a scan; larger ones may be half a head.
constexpr double min_part = 0.1;

/// Whole numbers, which may be too large for an int.
using Bin = std::array<double, 3>;

class Bins {
 public:
  Bins(const TriangleMesh& mesh, double size) {
    const Eigen::Vector3d corner = bounds(mesh).min();
    for (const Eigen::Vector3d& p : mesh.vertices) {
      const Eigen::Array3d place = ((p - corner) / size).array().floor();
      const Bin bin = {place.x(), place.y(), place.z()};
      of_vertex_.push_back(number_.try_emplace(bin, static_cast<int>(number_.size())).first->second);
    }
  }

  int of_vertex(int v) const { return of_vertex_[v]; }

  UnionFind neighbours_together() const {
    UnionFind sets(number_.size());
    for (const auto& [bin, number] : number_)
      for (int k = 0; k < 27; ++k) {
        const int x = k % 3 - 1, y = k / 3 % 3 - 1, z = k / 9 - 1;
        const auto it = number_.find({bin[0] + x, bin[1] + y, bin[2] + z});
        if (it != number_.end()) sets.unite(number, it->second);
      }
    return sets;
  }

 private:
  std::map<Bin, int> number_;
  std::vector<int> of_vertex_;
};

}  // namespace

TriangleMesh without_fragments(const TriangleMesh& mesh, double gap) {
  const Bins bins(mesh, gap);
  UnionFind sets = bins.neighbours_together();
  for (const Triangle& t : mesh.triangles)
    for (const int corner : {t[1], t[2]}) sets.unite(bins.of_vertex(t[0]), bins.of_vertex(corner));
  std::map<int, double> area;
  const auto part = [&](std::size_t t) { return sets.find(bins.of_vertex(mesh.triangles[t][0])); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area[part(t)] += area_normal(mesh, t).norm();
  const auto smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
  const double least = min_part * std::max_element(area.begin(), area.end(), smaller)->second;
  TriangleMesh kept{mesh.vertices, {}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (area[part(t)] >= least) kept.triangles.push_back(mesh.triangles[t]);
  return joined(kept);
}

}  // namespace kinetix::targets
