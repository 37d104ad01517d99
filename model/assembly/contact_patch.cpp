#include "model/assembly/contact_patch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/base/box_of.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

struct Facet {
  std::array<Vector3d, 3> corners;
  Vector3d normal;  // unit
  Eigen::AlignedBox3d box;
};

std::vector<Facet> facets_in(const Polyhedron& solid, const Eigen::AlignedBox3d& region) {
  std::vector<Facet> out;
  for (const auto& t : solid.triangles) {
    Facet f{{solid.points[t[0]], solid.points[t[1]], solid.points[t[2]]}, {}, {}};
    for (const Vector3d& p : f.corners) f.box.extend(p);
    if (!region.intersects(f.box)) continue;
    const Vector3d area = (f.corners[1] - f.corners[0]).cross(f.corners[2] - f.corners[0]);
    if (!(area.norm() > 0)) continue;
    f.normal = area.normalized();
    out.push_back(f);
  }
  std::sort(out.begin(), out.end(),
            [](const Facet& a, const Facet& b) { return a.box.min().x() < b.box.min().x(); });
  return out;
}

Eigen::AlignedBox3d grown(Eigen::AlignedBox3d box, double by) {
  box.min().array() -= by;
  box.max().array() += by;
  return box;
}

/// Returns the part of a polygon with inward . (p - on) >= 0.
std::vector<Vector3d> cut(const std::vector<Vector3d>& polygon, const Vector3d& on, const Vector3d& inward) {
  std::vector<Vector3d> out;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double a = inward.dot(p - on), b = inward.dot(q - on);
    if (a >= 0) out.push_back(p);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) out.push_back(p + a / (a - b) * (q - p));
  }
  return out;
}

/// Returns the part of the first facet inside the edges of the second one, seen along the second one's normal.
std::vector<Vector3d> common(const Facet& a, const Facet& b) {
  std::vector<Vector3d> polygon(a.corners.begin(), a.corners.end());
  for (int k = 0; k < 3 && !polygon.empty(); ++k) {
    const Vector3d side = b.corners[(k + 1) % 3] - b.corners[k];
    polygon = cut(polygon, b.corners[k], b.normal.cross(side).normalized());
  }
  return polygon;
}

bool face_each_other(const Facet& a, const Facet& b, const ContactTolerance& tolerance) {
  if (!(a.normal.dot(b.normal) < -std::cos(tolerance.angle))) return false;
  return grown(a.box, tolerance.gap_mm).intersects(b.box);
}

bool is_near(const std::vector<Vector3d>& polygon, const Facet& b, double gap) {
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const Vector3d& p) { return std::abs(b.normal.dot(p - b.corners[0])) <= gap; });
}

void add_piece(std::vector<Vector3d> polygon, ContactPatch& patch) {
  Vector3d area = Vector3d::Zero(), first = Vector3d::Zero();
  double whole = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vector3d part = 0.5 * (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]);
    area += part;
    whole += part.norm();
    first += part.norm() * (polygon[0] + polygon[k] + polygon[k + 1]) / 3;
  }
  if (!(whole > 0)) return;
  patch.area_mm2 += whole;
  patch.center += first;
  patch.normal += area;
  patch.pieces.push_back(std::move(polygon));
}

}  // namespace

ContactPatch contact_patch(const Polyhedron& a, const Polyhedron& b, const ContactTolerance& tolerance) {
  ContactPatch patch;
  const Eigen::AlignedBox3d of_a = grown(box_of(a.points), tolerance.gap_mm),
                            of_b = grown(box_of(b.points), tolerance.gap_mm);
  if (!of_a.intersects(of_b)) return patch;
  const std::vector<Facet> first = facets_in(a, of_b), second = facets_in(b, of_a);
  for (const Facet& f : first)
    for (const Facet& g : second) {
      if (g.box.min().x() > f.box.max().x() + tolerance.gap_mm) break;
      if (!face_each_other(f, g, tolerance)) continue;
      std::vector<Vector3d> polygon = common(f, g);
      if (polygon.size() >= 3 && is_near(polygon, g, tolerance.gap_mm)) add_piece(std::move(polygon), patch);
    }
  if (patch.area_mm2 > 0) {
    patch.center /= patch.area_mm2;
    patch.normal /= patch.area_mm2;
  }
  return patch;
}

}  // namespace kinetix::model
