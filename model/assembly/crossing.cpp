#include "model/assembly/crossing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

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
