#include "targets/helmet/head.hpp"

#include <map>
#include <numbers>
#include <utility>

#include "model/base/algorithms.hpp"
#include "model/base/decompositions.hpp"

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

/// The unit sphere by an icosahedron whose triangles are cut into four `levels` times: 10 * 4^levels + 2
/// vertices, mirrored in x, y and z, wound outward.
TriangleMesh sphere_grid(int levels) {
  TriangleMesh mesh = icosahedron();
  for (int level = 0; level < levels; ++level) mesh = finer(mesh);
  return mesh;
}

using Eigen::Vector3d;

/// Levels of an icosahedron whose triangles are cut into four. They give 40 962 directions over the sphere, one per
/// square degree, which is 1.3 mm at 75 mm. One more takes four times as long.
constexpr int grid_levels = 6;
/// Slope, mm per mm: how fast the distance from the core changes along the head. The outside of a head is
/// far from this; what is seen through a hole lies behind a step.
constexpr double steepest = 1.5;
/// Distance outside the surface, mm, of the point that is tested for being inside the head: beyond rounding, within
/// the noise of a scan.
constexpr double probe_offset_mm = 1e-3;

/// Directions down to the dome's boundary, and how far the head reaches in each.
class Dome {
 public:
  Dome(const MeshSolid& head, const Vector3d& core) : core_(core) {
    grid_ = joined(top_of(sphere_grid(grid_levels)));
    find_neighbours();
    for (const Vector3d& direction : grid_.vertices)
      radius_.push_back(head.tree().farthest_hit(core, direction).value_or(0));
    drop_faces_seen_through_holes(head);
    open_holes_at_boundary();
  }

  HeadDome closed() {
    HeadDome dome;
    const std::vector<int> holes = find_holes();
    close(holes);
    dome.closed = static_cast<int>(holes.size());
    dome.openings = openings(holes);
    dome.mesh.vertices.reserve(grid_.vertices.size());
    for (std::size_t v = 0; v < grid_.vertices.size(); ++v)
      dome.mesh.vertices.push_back(place(static_cast<int>(v)));
    for (const Triangle& t : grid_.triangles)
      if (std::none_of(t.begin(), t.end(), [&](int v) { return is_open_[v]; }))
        dome.mesh.triangles.push_back(t);
    dome.mesh = joined(dome.mesh);
    return dome;
  }

 private:
  static TriangleMesh top_of(TriangleMesh sphere) {
    const double lowest = std::cos(dome_angle);
    std::erase_if(sphere.triangles, [&](const Triangle& t) {
      return std::any_of(t.begin(), t.end(), [&](int v) { return sphere.vertices[v].z() < lowest; });
    });
    return sphere;
  }

  void find_neighbours() {
    neighbours_.resize(grid_.vertices.size());
    for (const Triangle& t : grid_.triangles)
      for (int k = 0; k < 3; ++k) {
        neighbours_[t[k]].push_back(t[(k + 1) % 3]);
        neighbours_[t[k]].push_back(t[(k + 2) % 3]);
      }
    for (auto& list : neighbours_) {
      std::sort(list.begin(), list.end());
      const std::size_t edge_sides = list.size();
      list.erase(std::unique(list.begin(), list.end()), list.end());
      is_boundary_.push_back(edge_sides != 2 * list.size());  // inside, every edge has two triangles
    }
  }

  /// Whether the head between two neighbours is too steep for its outside.
  bool is_cliff(int v, int w) const {
    const double along = (grid_.vertices[v] - grid_.vertices[w]).norm() * std::min(radius_[v], radius_[w]);
    return std::abs(radius_[v] - radius_[w]) > steepest * along;
  }

  /// Removes what is seen through holes. Cliffs divide the dome. Of two parts that meet at a cliff, the smaller is
  /// removed if most of it lies inside the head. (A part that protrudes, such as an ear, does not.)
  void drop_faces_seen_through_holes(const MeshSolid& head) {
    UnionFind parts(grid_.vertices.size());
    std::vector<std::pair<int, int>> cliffs;
    for (int v = 0; v < static_cast<int>(grid_.vertices.size()); ++v)
      for (const int w : neighbours_[v]) {
        if (w < v || is_missing(v) || is_missing(w)) continue;
        if (is_cliff(v, w))
          cliffs.emplace_back(v, w);
        else
          parts.unite(v, w);
      }
    std::vector<int> size(grid_.vertices.size(), 0);
    for (int v = 0; v < static_cast<int>(size.size()); ++v) ++size[parts.find(v)];
    std::vector<bool> is_forgotten(size.size(), false);
    for (const auto& [v, w] : cliffs) {
      const int a = parts.find(v), b = parts.find(w);
      if (a != b) is_forgotten[size[a] < size[b] ? a : b] = true;
    }
    std::vector<int> inside(size.size(), 0);
    const auto outer = [&](int v) -> Vector3d {
      return core_ + (radius_[v] + probe_offset_mm) * grid_.vertices[v];
    };
    for (int v = 0; v < static_cast<int>(size.size()); ++v)
      if (is_forgotten[parts.find(v)] && !is_missing(v)) inside[parts.find(v)] += head.contains(outer(v));
    for (int v = 0; v < static_cast<int>(size.size()); ++v)
      if (const int part = parts.find(v); is_forgotten[part] && 2 * inside[part] > size[part]) radius_[v] = 0;
  }

  bool is_missing(int v) const { return !(radius_[v] > 0); }

  void open_holes_at_boundary() {
    is_open_.assign(grid_.vertices.size(), false);
    std::vector<int> pending;
    const auto open = [&](int v) {
      if (!is_missing(v) || is_open_[v]) return;
      is_open_[v] = true;
      pending.push_back(v);
    };
    for (int v = 0; v < static_cast<int>(grid_.vertices.size()); ++v)
      if (is_boundary_[v]) open(v);
    while (!pending.empty()) {
      const int v = pending.back();
      pending.pop_back();
      for (const int next : neighbours_[v]) open(next);
    }
  }

  std::vector<int> find_holes() const {
    std::vector<int> holes;
    for (int v = 0; v < static_cast<int>(grid_.vertices.size()); ++v)
      if (is_missing(v) && !is_open_[v]) holes.push_back(v);
    return holes;
  }

  /// Sets every missing radius to the mean of its neighbours'.
  void close(const std::vector<int>& holes) {
    if (holes.empty()) return;
    std::vector<int> number(grid_.vertices.size(), -1);
    for (std::size_t h = 0; h < holes.size(); ++h) number[holes[h]] = static_cast<int>(h);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(holes.size());
    for (std::size_t h = 0; h < holes.size(); ++h) {
      entries.emplace_back(h, h, neighbours_[holes[h]].size());
      for (const int v : neighbours_[holes[h]]) {
        if (number[v] < 0)
          right[h] += radius_[v];
        else
          entries.emplace_back(h, number[v], -1);
      }
    }
    Eigen::SparseMatrix<double> means(holes.size(), holes.size());
    means.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd radii = SparseFactor(means).solve(right);
    for (std::size_t h = 0; h < holes.size(); ++h) radius_[holes[h]] = radii[h];
  }

  Vector3d place(int v) const { return core_ + radius_[v] * grid_.vertices[v]; }

  /// @param holes closed
  std::vector<DomeOpening> openings(const std::vector<int>& holes) const {
    std::vector<bool> is_hole(grid_.vertices.size(), false);
    for (const int v : holes) is_hole[v] = true;
    UnionFind parts(grid_.vertices.size());
    for (const int v : holes)
      for (const int w : neighbours_[v])
        if (is_hole[w]) parts.unite(v, w);
    std::map<int, std::vector<int>> members;
    for (const int v : holes) members[parts.find(v)].push_back(v);
    std::vector<DomeOpening> out;
    for (const auto& [part, vertices] : members) out.push_back(opening(vertices, is_hole));
    return out;
  }

  DomeOpening opening(const std::vector<int>& vertices, const std::vector<bool>& is_hole) const {
    std::vector<Vector3d> rim;
    DomeOpening out{0, place(vertices.front()).z()};
    for (const int v : vertices) {
      out.top_z = std::max(out.top_z, place(v).z());
      for (const int w : neighbours_[v])
        if (!is_hole[w]) rim.push_back(place(w));
    }
    for (const Vector3d& p : rim)
      for (const Vector3d& q : rim) out.width_mm = std::max(out.width_mm, (p - q).norm());
    return out;
  }

  Vector3d core_;
  TriangleMesh grid_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<bool> is_boundary_, is_open_;
  std::vector<double> radius_;
};

}  // namespace

HeadDome head_dome(const MeshSolid& head, const Vector3d& core) { return Dome(head, core).closed(); }

}  // namespace kinetix::targets
