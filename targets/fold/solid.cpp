#include "targets/fold/solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "model/base/box.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

constexpr double in_plane = 1e-9;  // edges of the solid: rounding of its corners is far below
// Edges of the solid: corners of files with four digits are within it of the plane of their face.
constexpr double in_plane_of_file = 2e-3;
constexpr double same_corner = 1e-4;  // ratio to the size of a mesh: corners that near are one
constexpr double same_area = 0.01;    // ratio: of a mesh and its hull, if it is convex

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

std::vector<Vector3d> cube() { return scaled(cyclic({1, 1, 1}), 0.5); }

using Corners = std::vector<Vector3d> (*)();
// In the order of solid_names().
constexpr Corners shapes[] = {tetrahedron,      octahedron,     icosahedron, dodecahedron,
                              triangular_prism, square_pyramid, cube};

/// Returns the corners within `flat` of the plane through three of them; empty if a corner is beyond it, and for three
/// on one line.
std::set<int> face_through(const std::vector<Vector3d>& p, int a, int b, int c, double flat) {
  const Vector3d across = (p[b] - p[a]).cross(p[c] - p[a]), normal = across.normalized();
  if (!(across.norm() > 0.1 * (p[b] - p[a]).norm() * (p[c] - p[a]).norm())) return {};
  std::set<int> face;
  for (int k = 0; k < static_cast<int>(p.size()); ++k) {
    const double above = normal.dot(p[k] - p[a]);
    if (above > flat) return {};
    if (above >= -flat) face.insert(k);
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
                                                 "dodecahedron", "triangular_prism", "square_pyramid",
                                                 "cube"};
  return names;
}

Solid named_solid(int index) { return hull_of(shapes[index]()); }

Solid hull_of(std::vector<Vector3d> corners, double flat) {
  Solid solid{std::move(corners), {}};
  const int count = static_cast<int>(solid.corners.size());
  std::set<std::set<int>> known;
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b)
      for (int c = 0; c < count; ++c) {
        if (a == b || b == c || a == c) continue;
        const std::set<int> face = face_through(solid.corners, a, b, c, flat);
        if (face.size() < 3 || !known.insert(face).second) continue;
        const auto& p = solid.corners;
        const Vector3d inwards = -(p[b] - p[a]).cross(p[c] - p[a]).normalized();
        solid.faces.push_back(in_order(p, face, inwards));
      }
  return solid;
}

namespace {

/// Returns the vertices of a mesh; those near another one are left out.
std::vector<Vector3d> corners_of(const TriangleMesh& mesh, double near) {
  std::vector<Vector3d> out;
  for (const Vector3d& p : mesh.vertices) {
    if (std::any_of(out.begin(), out.end(), [&](const Vector3d& q) { return (p - q).norm() <= near; }))
      continue;
    out.push_back(p);
    if (out.size() > 4 * max_solid_corners) break;
  }
  return out;
}

/// Scales a solid so that its shortest edge has length 1. @return its longest edge then
double normalise(Solid& solid) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const std::vector<int>& face : solid.faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const double length = (solid.corners[face[(k + 1) % face.size()]] - solid.corners[face[k]]).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  for (Vector3d& p : solid.corners) p /= shortest;
  return longest / shortest;
}

/// Keeps the corners at which three faces meet: others lie within a face or an edge.
/// @throws InvalidInput for a corner on no face
std::vector<Vector3d> pointed_corners(const Solid& hull) {
  std::vector<int> faces(hull.corners.size(), 0);
  for (const std::vector<int>& face : hull.faces)
    for (const int corner : face) ++faces[corner];
  std::vector<Vector3d> out;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (faces[k] == 0)
      throw InvalidInput("the solid is not convex: a corner lies inside its hull. Give a convex solid");
    if (faces[k] >= 3) out.push_back(hull.corners[k]);
  }
  return out;
}

double area_of(const Solid& solid) {
  double area = 0;
  for (const std::vector<int>& face : solid.faces)
    for (std::size_t k = 2; k < face.size(); ++k)
      area += (solid.corners[face[k - 1]] - solid.corners[face[0]])
                  .cross(solid.corners[face[k]] - solid.corners[face[0]])
                  .norm();
  return area / 2;
}

/// Returns the hull of corners in any unit.
Solid flat_hull(const std::vector<Vector3d>& corners) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) shortest = std::min(shortest, (corners[a] - corners[b]).norm());
  return hull_of(scaled(corners, 1 / shortest), in_plane_of_file);
}

}  // namespace

Solid solid_of(const TriangleMesh& mesh) {
  const double size = bounds(mesh).sizes().norm();
  const std::vector<Vector3d> given = corners_of(mesh, same_corner * size);
  if (given.size() < 4 || given.size() > max_solid_corners)
    throw InvalidInput(std::string("the solid has ") + (given.size() < 4 ? "fewer than 4" : "more than 60") +
                       " corners. Give a convex solid of 4 to 60 corners");
  Solid solid = flat_hull(pointed_corners(flat_hull(given)));
  std::size_t sides = 0;
  for (const std::vector<int>& face : solid.faces) sides += face.size();
  const bool is_closed = solid.faces.size() >= 4 && sides % 2 == 0 && edges_of(solid).size() == sides / 2 &&
                         solid.corners.size() + solid.faces.size() == sides / 2 + 2;
  if (!is_closed)
    throw InvalidInput(
        "the faces of the solid are not flat, or it has no volume. Give a convex solid of flat faces");
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += area_normal(mesh, t).norm() / 2;
  const double longest = normalise(solid), scale = size / model::box_of(solid.corners).sizes().norm();
  if (std::abs(area / (scale * scale * area_of(solid)) - 1) > same_area)
    throw InvalidInput(
        "the solid is open or not convex: its area is not that of its hull. Give a closed convex solid");
  if (longest > max_edge_ratio)
    throw InvalidInput("the longest edge of the solid is " + number_text(longest) +
                       " times as long as its shortest, and at most 4 is allowed. Give more equal edges");
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
