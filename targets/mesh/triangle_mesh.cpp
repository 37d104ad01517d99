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

/// Edges of a mesh that two triangles share, by their vertices in ascending order.
class SharedEdges {
 public:
  explicit SharedEdges(const TriangleMesh& mesh) : mesh_(mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) triangles_[edge(t, k)].push_back(static_cast<int>(t));
  }

  /// Returns the triangle beyond side k of a triangle; -1 for an edge of one triangle or of more than two.
  int beyond(int triangle, int k) const {
    const std::vector<int>& at = triangles_.at(edge(triangle, k));
    if (at.size() != 2 || at[0] == at[1]) return -1;
    return at[0] == triangle ? at[1] : at[0];
  }

  /// Whether two triangles run along side k of the first one in the same direction.
  bool runs_along(int triangle, int k, int other) const {
    const Triangle& t = mesh_.triangles[other];
    for (int side = 0; side < 3; ++side)
      if (t[side] == mesh_.triangles[triangle][k] &&
          t[(side + 1) % 3] == mesh_.triangles[triangle][(k + 1) % 3])
        return true;
    return false;
  }

 private:
  std::pair<int, int> edge(std::size_t triangle, int k) const {
    return std::minmax<int>({mesh_.triangles[triangle][k], mesh_.triangles[triangle][(k + 1) % 3]});
  }

  const TriangleMesh& mesh_;
  std::map<std::pair<int, int>, std::vector<int>> triangles_;
};

void flip(TriangleMesh& mesh, const std::vector<int>& triangles) {
  for (const int t : triangles) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

}  // namespace

TriangleMesh wound_alike(const TriangleMesh& mesh) {
  TriangleMesh out = mesh;
  std::erase_if(out.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  const TriangleMesh given = out;
  const SharedEdges edges(given);
  std::vector<int> turn(given.triangles.size(), 0);  // 1: as given, -1: flipped, 0: not reached yet
  for (std::size_t start = 0; start < turn.size(); ++start) {
    if (turn[start] != 0) continue;
    turn[start] = 1;
    std::vector<int> part = {static_cast<int>(start)}, flipped, kept;
    double area = 0;  // of triangles that keep their winding, less that of the others
    for (std::size_t next = 0; next < part.size(); ++next) {
      const int t = part[next];
      (turn[t] < 0 ? flipped : kept).push_back(t);
      area += turn[t] * area_normal(given, t).norm();
      for (int k = 0; k < 3; ++k) {
        const int other = edges.beyond(t, k);
        if (other < 0 || turn[other] != 0) continue;
        turn[other] = edges.runs_along(t, k, other) ? -turn[t] : turn[t];
        part.push_back(other);
      }
    }
    flip(out, area < 0 ? kept : flipped);
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
