#include "model/assembly/cylinder_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "model/base/algorithms.hpp"
#include "model/base/decompositions.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

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

constexpr int fits = 4;  // repetitions of the fit until only corners remain: two are usual

/// Direction normal to all facet normals, with the error of the fit.
struct FoundAxis {
  Vector3d direction;
  double lean = 0;  // rms of normal . axis over that of the next direction
};

FoundAxis axis_of(const std::vector<int>& region, const Polyhedron& solid, const Facets& facets) {
  Matrix3d spread = Matrix3d::Zero();
  for (const int t : region) {
    const auto& [a, b, c] = solid.triangles[t];
    const double area = (solid.points[b] - solid.points[a]).cross(solid.points[c] - solid.points[a]).norm();
    spread += area * facets.normals[t] * facets.normals[t].transpose();
  }
  const PrincipalAxes spreads = principal_axes(spread);
  return {spreads.axes.col(0), std::sqrt(std::max(0.0, spreads.values[0]) / spreads.values[1])};
}

/// Kasa's fit: x^2 + y^2 = 2 a x + 2 b y + c, linear in a, b and c.
Eigen::Vector3d circle_through(const std::vector<Vector2d>& points) {
  Eigen::MatrixX3d rows(points.size(), 3);
  Eigen::VectorXd squares(points.size());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    rows.row(k) << 2 * points[k].x(), 2 * points[k].y(), 1;
    squares[k] = points[k].squaredNorm();
  }
  const Eigen::Vector3d fit = least_squares(rows, squares);
  return {fit.x(), fit.y(), std::sqrt(std::max(0.0, fit.z() + fit.x() * fit.x() + fit.y() * fit.y()))};
}

/// Fits a circle only through the points that are on it in the end. Other points are on facets, where facets are cut
/// off.
Eigen::Vector3d circle_of_corners(std::vector<Vector2d> points) {
  Eigen::Vector3d circle = circle_through(points);
  for (int round_of_fit = 0; round_of_fit < fits; ++round_of_fit) {
    double outermost = 0;
    for (const Vector2d& p : points) outermost = std::max(outermost, (p - circle.head<2>()).norm());
    std::vector<Vector2d> corners;
    for (const Vector2d& p : points)
      if ((p - circle.head<2>()).norm() > (1 - 2 * roundness) * outermost) corners.push_back(p);
    if (corners.size() < 3) return circle;
    circle = circle_through(corners);
  }
  return circle;
}

std::optional<CylinderFace> fitted_cylinder(const std::vector<int>& region, const Polyhedron& solid,
                                            const Facets& facets, bool hollow) {
  const FoundAxis axis = axis_of(region, solid, facets);
  if (!(axis.lean < roundness)) return std::nullopt;
  Vector3d d = axis.direction;
  Eigen::Index lead = 0;
  d.cwiseAbs().maxCoeff(&lead);
  if (d[lead] < 0) d = -d;
  const Vector3d u = d.unitOrthogonal(), v = d.cross(u);
  CylinderFace face{hollow, {}, d};
  face.from = std::numeric_limits<double>::infinity();
  face.to = -face.from;
  std::set<int> corners;
  for (const int t : region) corners.insert(solid.triangles[t].begin(), solid.triangles[t].end());
  std::vector<Vector2d> flatly;
  const Vector3d origin = solid.points[*corners.begin()];
  for (const int p : corners) {
    const Vector3d r = solid.points[p] - origin;
    flatly.emplace_back(u.dot(r), v.dot(r));
    face.from = std::min(face.from, d.dot(solid.points[p]));
    face.to = std::max(face.to, d.dot(solid.points[p]));
  }
  const Vector3d circle = circle_of_corners(flatly);
  const Vector2d center = circle.head<2>();
  face.radius_mm = circle.z();
  face.turn = covered(flatly, center);
  face.point = origin + center.x() * u + center.y() * v;
  face.point += (0.5 * (face.from + face.to) - d.dot(face.point)) * d;
  if (!(face.turn > min_round_turn) || static_cast<int>(flatly.size()) < 2 * min_round_facets)
    return std::nullopt;
  face.inner_mm = face.radius_mm;
  for (const int t : region) {
    const double away = facets.normals[t].dot(facets.centers[t] - face.point);
    if (!((hollow ? -away : away) > 0)) return std::nullopt;
    face.inner_mm = std::min(face.inner_mm, std::abs(away));
  }
  const double slack = roundness * face.radius_mm + 1e-4;
  if (!(face.inner_mm >= flattest_facet * face.radius_mm)) return std::nullopt;
  for (const Vector2d& p : flatly) {
    const double off = (p - center).norm();
    if (!(off <= face.radius_mm + slack && off >= face.inner_mm - slack)) return std::nullopt;
  }
  return face;
}

Facets facets_of(const Polyhedron& solid) {
  Facets out;
  for (const auto& t : solid.triangles) {
    const Vector3d &a = solid.points[t[0]], &b = solid.points[t[1]], &c = solid.points[t[2]];
    out.normals.push_back((b - a).cross(c - a).stableNormalized());
    out.centers.push_back((a + b + c) / 3);
  }
  return out;
}

/// @param sign 1 for convex faces, -1 for hollow ones
std::vector<std::vector<int>> regions_of_sign(const Polyhedron& solid, const Facets& facets, double sign) {
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

}  // namespace

BentRegions bent_regions(const Polyhedron& solid) {
  BentRegions out{facets_of(solid), {}, {}};
  out.convex = regions_of_sign(solid, out.facets, 1);
  out.hollow = regions_of_sign(solid, out.facets, -1);
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

std::vector<CylinderFace> cylinder_faces(const Polyhedron& solid, const BentRegions& regions) {
  return fit_faces<CylinderFace>(solid, regions, fitted_cylinder);
}

std::optional<PinFit> pin_fit(const CylinderFace& rod, const CylinderFace& bore) {
  if (rod.hollow || !bore.hollow) return std::nullopt;
  const double clearance = bore.inner_mm - rod.radius_mm;
  if (!(clearance >= 0) || !(clearance <= max_bearing_play * rod.radius_mm)) return std::nullopt;
  if (!(std::abs(rod.axis.dot(bore.axis)) > std::cos(parallel_axes))) return std::nullopt;
  const Vector3d between = bore.point - rod.point;
  if (!((between - between.dot(rod.axis) * rod.axis).norm() <=
        std::max(clearance, roundness * rod.radius_mm)))
    return std::nullopt;
  const double middle = rod.axis.dot(bore.point), half = (bore.to - bore.from) / 2;
  const double from = std::max(rod.from, middle - half), to = std::min(rod.to, middle + half);
  if (!(to - from >= min_bearing_overlap * 2 * rod.radius_mm)) return std::nullopt;
  Vector3d point = (rod.point + bore.point) / 2;
  const Vector3d axis = (rod.axis + (rod.axis.dot(bore.axis) > 0 ? 1 : -1) * bore.axis).normalized();
  point += (0.5 * (from + to) - rod.axis.dot(point)) / rod.axis.dot(axis) * axis;
  return PinFit{point, axis, 2 * rod.radius_mm, clearance, to - from};
}

}  // namespace kinetix::model
