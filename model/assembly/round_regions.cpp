#include "model/assembly/cylinder_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/base/algorithms.hpp"

namespace kinetix::model {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Rad: a circle of twelve sides bends by 30 degrees per edge
constexpr double max_bend = 35 * radians_per_degree;
// Rad: two triangles below it are one facet; float rounding bends 1 mm by less
constexpr double flat_bend = 0.2 * radians_per_degree;

struct Edge {
  int a, b;         // points
  int left, right;  // triangles
};

std::vector<Edge> inner_edges(const Polyhedron& solid) {
  std::map<std::pair<int, int>, int> forward;
  for (int t = 0; t < static_cast<int>(solid.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) forward[{solid.triangles[t][k], solid.triangles[t][(k + 1) % 3]}] = t;
  std::vector<Edge> out;
  for (const auto& [ends, left] : forward) {
    if (ends.first > ends.second) continue;
    const auto other = forward.find({ends.second, ends.first});
    if (other != forward.end()) out.push_back({ends.first, ends.second, left, other->second});
  }
  return out;
}

/// Returns the signed bend of the surface across an edge, rad: positive if it is convex.
double bend(const Polyhedron& solid, const Facets& facets, const Edge& e) {
  const Vector3d along = (solid.points[e.b] - solid.points[e.a]).stableNormalized();
  const Vector3d &left = facets.normals[e.left], &right = facets.normals[e.right];
  return std::atan2(left.cross(right).dot(along), left.dot(right));
}

}  // namespace

Facets facets_of(const Polyhedron& solid) {
  Facets out;
  for (const auto& t : solid.triangles) {
    const Vector3d &a = solid.points[t[0]], &b = solid.points[t[1]], &c = solid.points[t[2]];
    out.normals.push_back((b - a).cross(c - a).stableNormalized());
    out.centers.push_back((a + b + c) / 3);
  }
  return out;
}

std::vector<std::vector<int>> bent_regions(const Polyhedron& solid, const Facets& facets, double sign) {
  UnionFind sets(solid.triangles.size());
  std::vector<char> is_bent(solid.triangles.size(), 0);
  for (const Edge& e : inner_edges(solid)) {
    const double turn = sign * bend(solid, facets, e);
    if (!(turn > -flat_bend && turn < max_bend)) continue;
    sets.unite(e.left, e.right);
    if (turn > flat_bend) is_bent[e.left] = is_bent[e.right] = 1;
  }
  std::map<int, std::vector<int>> regions;
  for (int t = 0; t < static_cast<int>(solid.triangles.size()); ++t)
    if (facets.normals[t].norm() > 0) regions[sets.find(t)].push_back(t);
  std::vector<std::vector<int>> out;
  for (auto& [first, region] : regions)
    if (std::any_of(region.begin(), region.end(), [&](int t) { return is_bent[t] != 0; }))
      out.push_back(std::move(region));
  return out;
}

double covered(const std::vector<Vector2d>& points, const Vector2d& center) {
  std::vector<double> angles;
  for (const Vector2d& p : points) angles.push_back(std::atan2(p.y() - center.y(), p.x() - center.x()));
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2 * pi - angles.back();
  for (std::size_t k = 1; k < angles.size(); ++k) gap = std::max(gap, angles[k] - angles[k - 1]);
  return gap < max_bend + flat_bend ? 2 * pi : 2 * pi - gap;
}

}  // namespace kinetix::model
