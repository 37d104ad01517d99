#include "model/assembly/soft_hinge.hpp"

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

#include "model/base/box.hpp"
#include "model/base/decompositions.hpp"

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

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

struct Segment {
  Vector2d from, to;
};

Vector2d in_plane(const PlaneFrame& frame, const Vector3d& p) { return {frame.u.dot(p), frame.v.dot(p)}; }

/// Computes the segment in which the plane cuts a triangle, counter-clockwise about d with the solid on the left.
/// Corners in the plane count as above it, so that loops close. Returns false if there is no cut.
bool cuts(const std::array<Vector3d, 3>& corners, const PlaneFrame& frame, double at, Segment& out) {
  std::array<Vector2d, 2> ends;
  int found = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &p = corners[k], &q = corners[(k + 1) % 3];
    const double a = frame.d.dot(p) - at, b = frame.d.dot(q) - at;
    if ((a >= 0) == (b >= 0)) continue;
    ends[(a >= 0) ? 0 : 1] = in_plane(frame, p + a / (a - b) * (q - p));
    ++found;
  }
  // A triangle that is counter-clockwise from outside crosses the plane downwards at the start of its segment.
  out = {ends[0], ends[1]};
  return found == 2;
}

void add_moments(const Segment& s, double& area, Vector2d& first, Matrix2d& second) {
  const double part = (s.from.x() * s.to.y() - s.from.y() * s.to.x()) / 2;
  area += part;
  first += part * (s.from + s.to) / 3;
  const Vector2d sum = s.from + s.to;
  second += part / 12 * (sum * sum.transpose() + s.from * s.from.transpose() + s.to * s.to.transpose());
}

}  // namespace

PlaneFrame PlaneFrame::across(const Vector3d& d) {
  const Vector3d u = d.unitOrthogonal();
  return {u, d.cross(u), d};
}

CrossSection cross_section(const Polyhedron& solid, const PlaneFrame& frame, double at) {
  CrossSection out;
  Vector2d first = Vector2d::Zero();
  Matrix2d second = Matrix2d::Zero();
  std::complex<double> order = 0;
  double length = 0;
  const Vector2d origin = solid.points.empty() ? Vector2d::Zero() : in_plane(frame, solid.points.front());
  for (const auto& t : solid.triangles) {
    Segment s;
    if (!cuts({solid.points[t[0]], solid.points[t[1]], solid.points[t[2]]}, frame, at, s)) continue;
    s.from -= origin;
    s.to -= origin;
    add_moments(s, out.area_mm2, first, second);
    const Vector2d along = s.to - s.from;
    length += along.norm();
    order += along.norm() * std::polar(1.0, 4 * std::atan2(along.y(), along.x()));
  }
  if (!(out.area_mm2 > 0)) return {};
  const Vector2d center = first / out.area_mm2;
  out.center = origin + center;
  out.second = second - out.area_mm2 * center * center.transpose();
  out.edge_order = std::abs(order) / length;
  out.edge_angle = std::fmod(std::arg(order) / 4 + pi / 2, pi / 2);
  return out;
}

namespace {

// Sections on the path, each in the middle of its share: this resolves a fillet or a waist to a hundredth of the
// path.
constexpr int sections = 128;
// Length of the difference of two unit normals: above, the patches oppose each other by more than 60 degrees.
constexpr double opposing = 1;

/// Integrals over the path from patch to patch.
struct Beam {
  PlaneFrame frame;
  double from = 0, length = 0;             // range of d . p, mm
  Matrix2d compliance = Matrix2d::Zero();  // C, 1/mm^3
  Vector3d point = Vector3d::Zero();  // mean section center weighted by the trace of each section's share, mm
  double pull = 0;                    // integral of dx / area, 1/mm
  double waist = 0;                   // d . p of the most compliant section, mm
  double edge_angle = 0;              // edge angle of that section, rad
};

Vector3d direction(const ContactPatch& first, const ContactPatch& second) {
  const Vector3d opposed = second.normal.stableNormalized() - first.normal.stableNormalized();
  const Vector3d apart = second.center - first.center;
  if (opposed.norm() > opposing && opposed.dot(apart) > 0) return opposed.normalized();
  return apart.stableNormalized();
}

/// Returns the extent of a patch along d, mm.
std::pair<double, double> extent(const ContactPatch& patch, const Vector3d& d) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& piece : patch.pieces)
    for (const Vector3d& p : piece) {
      low = std::min(low, d.dot(p));
      high = std::max(high, d.dot(p));
    }
  return {low, high};
}

/// Returns the bending inertias about the directions of the plane: a moment about u bends over v.
Matrix2d bending(const Matrix2d& second) {
  Matrix2d out;
  out << second(1, 1), -second(0, 1), -second(0, 1), second(0, 0);
  return out;
}

void add_section(const CrossSection& section, double at, double share, double& most, Beam& beam) {
  const Matrix2d yields = share * bending(section.second).inverse();
  if (!yields.allFinite()) return;
  const PlaneFrame& f = beam.frame;
  beam.compliance += yields;
  beam.point += yields.trace() * (section.center.x() * f.u + section.center.y() * f.v + at * f.d);
  beam.pull += share / section.area_mm2;
  if (yields.trace() <= most * (1 + 1e-9)) return;
  most = yields.trace();
  beam.waist = at;
  beam.edge_angle = section.edge_angle;
}

std::optional<Beam> beam_between(const Polyhedron& soft, const ContactPatch& first,
                                 const ContactPatch& second) {
  Beam beam{PlaneFrame::across(direction(first, second))};
  const Vector3d& d = beam.frame.d;
  double to = extent(second, d).first;
  beam.from = extent(first, d).second;
  if (!(to > beam.from)) {
    beam.from = d.dot(first.center);
    to = d.dot(second.center);
  }
  beam.length = to - beam.from;
  if (!(beam.length > 0)) return std::nullopt;
  double most = 0;
  for (int k = 0; k < sections; ++k) {
    const double at = beam.from + (k + 0.5) / sections * beam.length;
    const CrossSection section = cross_section(soft, beam.frame, at);
    if (section.area_mm2 > 0) add_section(section, at, beam.length / sections, most, beam);
  }
  const double weight = beam.compliance.trace();
  if (!(weight > 0) || !std::isfinite(weight)) return std::nullopt;
  beam.point /= weight;
  return beam;
}

Vector3d with_positive_lead(Vector3d axis) {
  Eigen::Index lead = 0;
  axis.cwiseAbs().maxCoeff(&lead);
  if (axis[lead] < 0) axis = -axis;
  return axis;
}

/// Returns the extent of the soft part along a direction, at the waist, mm.
double height_at(const Polyhedron& soft, const Beam& beam, const Vector3d& axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& t : soft.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vector3d &p = soft.points[t[k]], &q = soft.points[t[(k + 1) % 3]];
      const double a = beam.frame.d.dot(p) - beam.waist, b = beam.frame.d.dot(q) - beam.waist;
      if ((a >= 0) == (b >= 0)) continue;
      const double s = axis.dot(p + a / (a - b) * (q - p));
      low = std::min(low, s);
      high = std::max(high, s);
    }
  return high - low;
}

/// Returns the direction in the plane with the larger eigenvalue. @pre C is positive: the third direction's zero is
/// the least
Vector2d most_compliant_direction(const Matrix2d& compliance) {
  Eigen::Matrix3d embedded = Eigen::Matrix3d::Zero();
  embedded.topLeftCorner<2, 2>() = compliance;
  return principal_axes(embedded).axes.col(2).head<2>();
}

/// Creates the equivalent block: its length, its height, and thicknesses with the same compliance in bending and in
/// pull.
SoftHinge about(const Beam& beam, const Polyhedron& soft, const Vector2d& axis) {
  const Vector2d across(-axis.y(), axis.x());
  const double yields = axis.dot(beam.compliance * axis), other = across.dot(beam.compliance * across);
  SoftHinge hinge;
  hinge.along = beam.frame.d;
  hinge.axis = with_positive_lead((axis.x() * beam.frame.u + axis.y() * beam.frame.v).normalized());
  hinge.other = with_positive_lead((across.x() * beam.frame.u + across.y() * beam.frame.v).normalized());
  hinge.point = beam.point;
  hinge.confidence = std::clamp(1 - other / yields, 0.0, 1.0);
  hinge.length_mm = beam.length;
  hinge.height_mm = height_at(soft, beam, hinge.axis);
  hinge.bending_mm = std::cbrt(12 * beam.length / (hinge.height_mm * yields));
  hinge.pulling_mm = beam.length / (hinge.height_mm * beam.pull);
  return hinge;
}

}  // namespace

bool SoftHinge::is_ambiguous() const { return !(confidence >= min_confidence); }

std::optional<SoftHinge> soft_hinge(const Polyhedron& soft, const ContactPatch& first,
                                    const ContactPatch& second) {
  const std::optional<Beam> beam = beam_between(soft, first, second);
  if (!beam) return std::nullopt;
  SoftHinge hinge = about(*beam, soft, most_compliant_direction(beam->compliance));
  if (!hinge.is_ambiguous()) return hinge;
  // Without a preferred direction, the directions of the section's sides are the intended ones.
  const Vector2d side(std::cos(beam->edge_angle), std::sin(beam->edge_angle));
  return about(*beam, soft, side);
}

SoftHinge turned_to(const SoftHinge& hinge, const Polyhedron& soft, const ContactPatch& first,
                    const ContactPatch& second, const Vector3d& axis) {
  const std::optional<Beam> beam = beam_between(soft, first, second);
  const Vector2d in_plane(beam->frame.u.dot(axis), beam->frame.v.dot(axis));
  SoftHinge out = about(*beam, soft, in_plane.normalized());
  out.confidence = 1;
  out.point = hinge.point;
  return out;
}

HingeStiffness stiffness(const SoftHinge& hinge, const Material& material) {
  ManufacturedHinge block{.kind = HingeKind::block,
                          .material = material,
                          .gap_mm = hinge.length_mm,
                          .thickness_mm = hinge.bending_mm,
                          .height_mm = hinge.height_mm};
  const HingeStiffness bent = stiffness(block);
  block.thickness_mm = hinge.pulling_mm;
  HingeStiffness out = stiffness(block);
  out.turn = bent.turn;
  return out;
}

double reach_mm(const SoftHinge& hinge) { return hinge.height_mm / std::sqrt(12.0); }

}  // namespace kinetix::model
