#include "model/assembly/shells.hpp"

#include <Eigen/Geometry>
#include <cstdio>
#include <limits>
#include <map>
#include <unordered_map>

#include "model/base/algorithms.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

// Volume relative to the cube of a shell's extent: a smaller one is a folded sheet of paper, not a solid.
constexpr double min_filling = 1e-9;

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
  std::vector<bool> is_paired(end - first);
  for (std::size_t a = first; a < end; ++a) {
    if (is_paired[a - first]) continue;
    for (std::size_t b = a + 1; b < end; ++b) {
      if (is_paired[b - first] || edges[b].forward == edges[a].forward) continue;
      sets.unite(edges[a].triangle, edges[b].triangle);
      is_paired[b - first] = true;
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
      defect = "is open: a triangle ends at " + at + " and no other continues it";
    else if (end - first == 2 && forward != 1)
      defect = "has neighbours wound against each other at " + at;
    else if (end - first > 2)
      defect = "has an edge of " + std::to_string(end - first) + " triangles at " + at;
  });
  if (!defect.empty()) return defect;
  const double volume = volume_mm3(shell);
  double extent = 0;
  for (const Vector3d& p : shell.points) extent = std::max(extent, (p - shell.points.front()).norm());
  if (std::abs(volume) <= min_filling * extent * extent * extent) return "encloses no volume";
  if (volume < 0)
    return "is inside out, or a sealed void: its triangles face inwards at " +
           place_text(shell.points.front());
  return {};
}

namespace {

struct Tile {
  std::array<int, 3> corners;  // indices
  std::array<Vector3d, 3> at;
  Vector3d normal;  // unit; zero where it has no area
  Eigen::AlignedBox3d box;
};

std::vector<Tile> tiles_of(const Polyhedron& solid) {
  std::vector<Tile> out;
  out.reserve(solid.triangles.size());
  for (const auto& t : solid.triangles) {
    Tile tile{t, {solid.points[t[0]], solid.points[t[1]], solid.points[t[2]]}, {}, {}};
    tile.normal = (tile.at[1] - tile.at[0]).cross(tile.at[2] - tile.at[0]).stableNormalized();
    for (const Vector3d& p : tile.at) tile.box.extend(p);
    out.push_back(tile);
  }
  std::sort(out.begin(), out.end(),
            [](const Tile& a, const Tile& b) { return a.box.min().x() < b.box.min().x(); });
  return out;
}

bool have_common_point(const Tile& a, const Tile& b) {
  for (const int p : a.corners)
    if (std::find(b.corners.begin(), b.corners.end(), p) != b.corners.end()) return true;
  return false;
}

/// Returns the distance of a point from the nearest side, inwards, mm.
double inside_by(const Tile& t, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = t.at[(k + 1) % 3] - t.at[k];
    least = std::min(least, t.normal.cross(side).normalized().dot(p - t.at[k]));
  }
  return least;
}

std::optional<Vector3d> through(const Tile& edges, const Tile& t, double depth) {
  if (!(t.normal.norm() > 0)) return std::nullopt;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &p = edges.at[k], &q = edges.at[(k + 1) % 3];
    const double a = t.normal.dot(p - t.at[0]), b = t.normal.dot(q - t.at[0]);
    if (!(std::min(a, b) < -depth && std::max(a, b) > depth)) continue;
    const Vector3d place = p + a / (a - b) * (q - p);
    if (inside_by(t, place) > depth) return place;
  }
  return std::nullopt;
}

std::optional<Vector3d> meeting(const Tile& a, const Tile& b, double depth) {
  if (!a.box.intersects(b.box)) return std::nullopt;
  if (const auto place = through(a, b, depth)) return place;
  return through(b, a, depth);
}

Eigen::AlignedBox3d box_around(const std::vector<Tile>& tiles) {
  Eigen::AlignedBox3d box;
  for (const Tile& t : tiles) box.extend(t.box);
  return box;
}

}  // namespace

std::optional<Vector3d> crossing(const Polyhedron& a, const Polyhedron& b, double depth) {
  std::vector<Tile> first = tiles_of(a), second = tiles_of(b);
  const Eigen::AlignedBox3d both = box_around(first).intersection(box_around(second));
  if (both.isEmpty()) return std::nullopt;
  const auto apart = [&](const Tile& t) { return !both.intersects(t.box); };
  std::erase_if(first, apart);
  std::erase_if(second, apart);
  for (const Tile& s : first)
    for (const Tile& t : second) {
      if (t.box.min().x() > s.box.max().x()) break;
      if (const auto place = meeting(s, t, depth)) return place;
    }
  return std::nullopt;
}

std::optional<Vector3d> self_crossing(const Polyhedron& shell, double depth) {
  const std::vector<Tile> tiles = tiles_of(shell);
  for (std::size_t k = 0; k < tiles.size(); ++k)
    for (std::size_t l = k + 1; l < tiles.size(); ++l) {
      if (tiles[l].box.min().x() > tiles[k].box.max().x()) break;
      if (have_common_point(tiles[k], tiles[l])) continue;
      if (const auto place = meeting(tiles[k], tiles[l], depth)) return place;
    }
  return std::nullopt;
}

bool is_inside(const Polyhedron& solid, const Vector3d& p) {
  // Direction of no face in usual drawings
  const Vector3d ray = Vector3d(0.5773, 0.2113, 0.7887).normalized();
  bool inside = false;
  for (const auto& t : solid.triangles) {
    const Vector3d &a = solid.points[t[0]], e = solid.points[t[1]] - a, f = solid.points[t[2]] - a;
    const Vector3d h = ray.cross(f);
    const double det = e.dot(h);
    if (det == 0) continue;
    const Vector3d s = p - a, q = s.cross(e);
    const double u = s.dot(h) / det, v = ray.dot(q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && f.dot(q) / det > 0) inside = !inside;
  }
  return inside;
}

}  // namespace kinetix::model
