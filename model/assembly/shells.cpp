#include "model/assembly/shells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <unordered_map>

#include "model/base/union_find.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Volume relative to the cube of a shell's extent: a smaller one is a folded sheet of paper, not a solid.
constexpr double least_filling = 1e-9;

struct PointKey {
  std::array<double, 3> at;
  bool operator==(const PointKey&) const = default;
};

struct PointHash {
  std::size_t operator()(const PointKey& key) const {
    std::size_t h = 0;
    for (const double x : key.at) h = h * 1000003u + std::hash<double>()(x);
    return h;
  }
};

/// Returns the grid cell of a point. -0 and 0 are one number.
PointKey key_of(const Vector3d& p, double tolerance) {
  PointKey key;
  for (int k = 0; k < 3; ++k) key.at[k] = (tolerance > 0 ? std::round(p[k] / tolerance) : p[k]) + 0.0;
  return key;
}

struct HalfEdge {
  int low, high, triangle;
  bool forward;
};

std::vector<HalfEdge> sorted_edges(const Polyhedron& soup) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * soup.triangles.size());
  for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = soup.triangles[t][k], to = soup.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), t, from < to});
    }
  std::stable_sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high);
  });
  return edges;
}

/// Calls f for each run of half edges of one edge.
template <class F>
void for_each_edge(const std::vector<HalfEdge>& edges, const F& f) {
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t end = first;
    while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high)
      ++end;
    f(first, end);
    first = end;
  }
}

/// Pairs the half edges of one edge in the list's order, each with the next free one of the opposite direction.
void unite_in_pairs(const std::vector<HalfEdge>& edges, std::size_t first, std::size_t end, UnionFind& sets) {
  std::vector<bool> taken(end - first);
  for (std::size_t a = first; a < end; ++a) {
    if (taken[a - first]) continue;
    for (std::size_t b = a + 1; b < end; ++b) {
      if (taken[b - first] || edges[b].forward == edges[a].forward) continue;
      sets.unite(edges[a].triangle, edges[b].triangle);
      taken[b - first] = true;
      break;
    }
  }
}

std::string place_text(const Vector3d& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g) mm", p.x(), p.y(), p.z());
  return text;
}

}  // namespace

Polyhedron welded(const Polyhedron& soup, double tolerance) {
  Polyhedron out;
  std::unordered_map<PointKey, int, PointHash> known;
  std::vector<int> index(soup.points.size(), -1);
  const auto of = [&](int p) {
    if (index[p] < 0) {
      const auto [found, is_new] =
          known.try_emplace(key_of(soup.points[p], tolerance), static_cast<int>(out.points.size()));
      if (is_new) out.points.push_back(soup.points[p]);
      index[p] = found->second;
    }
    return index[p];
  };
  for (const auto& t : soup.triangles) {
    const std::array<int, 3> corners{of(t[0]), of(t[1]), of(t[2])};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      out.triangles.push_back(corners);
  }
  return out;
}

std::vector<Polyhedron> shells(const Polyhedron& soup) {
  UnionFind sets(soup.triangles.size());
  const std::vector<HalfEdge> edges = sorted_edges(soup);
  for_each_edge(edges, [&](std::size_t first, std::size_t end) { unite_in_pairs(edges, first, end, sets); });
  std::map<int, Polyhedron> parts;
  for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t)
    parts[sets.find(t)].triangles.push_back(soup.triangles[t]);
  std::vector<Polyhedron> out;
  for (auto& [first, part] : parts) {
    std::unordered_map<int, int> own;
    for (auto& t : part.triangles)
      for (int& p : t) {
        const auto [found, is_new] = own.try_emplace(p, static_cast<int>(part.points.size()));
        if (is_new) part.points.push_back(soup.points[p]);
        p = found->second;
      }
    out.push_back(std::move(part));
  }
  return out;
}

std::string shell_defect(const Polyhedron& shell) {
  if (shell.triangles.empty()) return "is empty";
  std::string defect;
  const std::vector<HalfEdge> edges = sorted_edges(shell);
  for_each_edge(edges, [&](std::size_t first, std::size_t end) {
    if (!defect.empty()) return;
    const auto forward =
        std::count_if(edges.begin() + static_cast<long>(first), edges.begin() + static_cast<long>(end),
                      [](const HalfEdge& e) { return e.forward; });
    const std::string at = place_text((shell.points[edges[first].low] + shell.points[edges[first].high]) / 2);
    if (end - first == 1)
      defect = "is open: a triangle ends at " + at + " and no other goes on";
    else if (end - first == 2 && forward != 1)
      defect = "has neighbours wound against each other at " + at;
    else if (end - first > 2)
      defect = "has an edge of " + std::to_string(end - first) + " triangles at " + at;
  });
  if (!defect.empty()) return defect;
  const double volume = volume_mm3(shell);
  double extent = 0;
  for (const Vector3d& p : shell.points) extent = std::max(extent, (p - shell.points.front()).norm());
  if (std::abs(volume) <= least_filling * extent * extent * extent) return "encloses no volume";
  if (volume < 0)
    return "is inside out, or a sealed void: its triangles face inwards at " +
           place_text(shell.points.front());
  return {};
}

}  // namespace kinetix::model
