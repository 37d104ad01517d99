#include "targets/fold/solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

constexpr double in_plane = 1e-9;  // edges of the solid: rounding of its corners is far below

/// A corner with all signs and cyclic orders of its coordinates.
std::vector<Vector3d> cyclic(const Vector3d& at) {
  std::vector<Vector3d> all;
  for (int turn = 0; turn < 3; ++turn)
    for (int signs = 0; signs < 8; ++signs) {
      Vector3d p;
      for (int k = 0; k < 3; ++k) p[(k + turn) % 3] = (signs >> k & 1) != 0 ? -at[k] : at[k];
      if (std::none_of(all.begin(), all.end(), [&](const Vector3d& q) { return (p - q).norm() < in_plane; }))
        all.push_back(p);
    }
  return all;
}

std::vector<Vector3d> scaled(std::vector<Vector3d> corners, double factor) {
  for (Vector3d& p : corners) p *= factor;
  return corners;
}

std::vector<Vector3d> tetrahedron() {
  return scaled({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 1 / std::sqrt(8.0));
}

std::vector<Vector3d> octahedron() { return scaled(cyclic({1, 0, 0}), 1 / std::sqrt(2.0)); }

const double golden = (1 + std::sqrt(5.0)) / 2;  // 1: the golden ratio, of the coordinates of regular solids

std::vector<Vector3d> icosahedron() { return scaled(cyclic({0, 1, golden}), 0.5); }

std::vector<Vector3d> dodecahedron() {
  std::vector<Vector3d> corners = cyclic({1, 1, 1});
  for (const Vector3d& p : cyclic({0, 1 / golden, golden})) corners.push_back(p);
  return scaled(std::move(corners), golden / 2);
}

std::vector<Vector3d> triangular_prism() {
  std::vector<Vector3d> corners;
  const double height = std::sqrt(3.0) / 2;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.5, height}}) corners.emplace_back(x, y, z);
  return corners;
}

std::vector<Vector3d> square_pyramid() {
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}};
}

using Corners = std::vector<Vector3d> (*)();
// In the order of solid_names().
constexpr Corners shapes[] = {tetrahedron,  octahedron,       icosahedron,
                              dodecahedron, triangular_prism, square_pyramid};

/// Returns the corners in the plane through three of them; empty if a corner is beyond it.
std::set<int> face_through(const std::vector<Vector3d>& p, int a, int b, int c) {
  const Vector3d normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
  std::set<int> face;
  for (int k = 0; k < static_cast<int>(p.size()); ++k) {
    const double above = normal.dot(p[k] - p[a]);
    if (above > in_plane) return {};
    if (above >= -in_plane) face.insert(k);
  }
  return face;
}

Vector3d middle(const std::vector<Vector3d>& p, const std::vector<int>& of) {
  Vector3d sum = Vector3d::Zero();
  for (const int k : of) sum += p[k];
  return sum / static_cast<double>(of.size());
}

/// Sorts the corners of a face counter-clockwise as seen against the normal.
std::vector<int> in_order(const std::vector<Vector3d>& p, const std::set<int>& face, const Vector3d& normal) {
  std::vector<int> order(face.begin(), face.end());
  const Vector3d center = middle(p, order), x = (p[order[0]] - center).normalized(), y = normal.cross(x);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto angle = [&](int k) { return std::atan2(y.dot(p[k] - center), x.dot(p[k] - center)); };
    return angle(a) < angle(b);
  });
  return order;
}

Vector3d normal_of(const Solid& solid, int face) {
  const std::vector<int>& f = solid.faces[face];
  const auto& p = solid.corners;
  return (p[f[1]] - p[f[0]]).cross(p[f[2]] - p[f[1]]).normalized();
}

}  // namespace

const std::vector<std::string>& solid_names() {
  static const std::vector<std::string> names = {"tetrahedron",  "octahedron",       "icosahedron",
                                                 "dodecahedron", "triangular_prism", "square_pyramid"};
  return names;
}

Solid named_solid(int index) { return hull_of(shapes[index]()); }

Solid hull_of(std::vector<Vector3d> corners) {
  Solid solid{std::move(corners), {}};
  const int count = static_cast<int>(solid.corners.size());
  std::set<std::set<int>> known;
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b)
      for (int c = 0; c < count; ++c) {
        if (a == b || b == c || a == c) continue;
        const std::set<int> face = face_through(solid.corners, a, b, c);
        if (face.size() < 3 || !known.insert(face).second) continue;
        const auto& p = solid.corners;
        const Vector3d inwards = -(p[b] - p[a]).cross(p[c] - p[a]).normalized();
        solid.faces.push_back(in_order(p, face, inwards));
      }
  return solid;
}

std::vector<SolidEdge> edges_of(const Solid& solid) {
  std::map<std::pair<int, int>, std::pair<int, int>> sides;  // from corner to corner: face and side
  std::vector<SolidEdge> edges;
  for (int f = 0; f < static_cast<int>(solid.faces.size()); ++f)
    for (int k = 0; k < static_cast<int>(solid.faces[f].size()); ++k) {
      const int a = solid.faces[f][k], b = solid.faces[f][(k + 1) % solid.faces[f].size()];
      sides[{a, b}] = {f, k};
      if (const auto other = sides.find({b, a}); other != sides.end()) {
        const auto [first, first_side] = other->second;
        const double cosine = normal_of(solid, first).dot(normal_of(solid, f));
        edges.push_back({first, first_side, f, k, std::acos(std::clamp(cosine, -1.0, 1.0))});
      }
    }
  return edges;
}

}  // namespace kinetix::targets
