#include "targets/head.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "targets/head_dome.hpp"
#include "targets/mesh_fragments.hpp"
#include "targets/mesh_section.hpp"

namespace kinetix {
namespace {

using Eigen::Vector3d;

/// Parts farther than this from the head float beside it, mm.
constexpr double fragment_gap_mm = 5;
/// The longer way of a head is measured down to this depth below its top, above nose and ears, mm.
constexpr double length_depth_mm = 60;
/// Size that a head mesh is expected to have, mm, to choose among units.
constexpr double usual_head_mm = 250;
/// Over which directions along curves are taken, mm.
constexpr double direction_reach_mm = 15;
/// Coverage ends this far before the dome does, so that sections there are whole, mm.
constexpr double rim_mm = 5;

struct NamedUnit {
  LengthUnit unit;
  const char* name;
  double mm;
};
constexpr std::array<NamedUnit, 4> units = {{{LengthUnit::mm, "mm", 1},
                                             {LengthUnit::cm, "cm", 10},
                                             {LengthUnit::m, "m", 1000},
                                             {LengthUnit::inch, "in", 25.4}}};

const NamedUnit& named(LengthUnit unit) {
  return *std::find_if(units.begin(), units.end(), [&](const NamedUnit& u) { return u.unit == unit; });
}

bool is_size_of_head(double mm) { return mm >= least_head_mm && mm <= most_head_mm; }

/// What to do about a mesh of this size in the file's units.
std::string remedy(double size) {
  const auto strangeness = [&](const NamedUnit& u) {
    return std::abs(std::log(size * u.mm / usual_head_mm));
  };
  const auto best = std::min_element(units.begin(), units.end(), [&](const NamedUnit& a, const NamedUnit& b) {
    return strangeness(a) < strangeness(b);
  });
  if (!is_size_of_head(size * best->mm)) return "; none of the units mm, cm, m, in would do: scale the mesh";
  return "; `units: " + std::string(best->name) + "` would make it " + number_text(size * best->mm) + " mm";
}

/// @param mesh in mm
void check_size(const TriangleMesh& mesh, LengthUnit unit) {
  const double size = bounds(mesh).sizes().maxCoeff();
  if (is_size_of_head(size)) return;
  throw InvalidHead("units", "in " + std::string(named(unit).name) + " the mesh is " + number_text(size) +
                                 " mm long; a head (or a bust) is " + number_text(least_head_mm) + " to " +
                                 number_text(most_head_mm) + " mm" + remedy(size / mm_per(unit)));
}

TriangleMesh moved(TriangleMesh mesh, const Eigen::Affine3d& motion) {
  for (Vector3d& p : mesh.vertices) p = motion * p;
  return mesh;
}

/// Columns: the head frame's axes in those of the mesh.
Eigen::Matrix3d axes_of(const Vector3d& front, const Vector3d& up) {
  Eigen::Matrix3d axes;
  axes << front.cross(up), front, up;
  return axes;
}

const Vector3d& highest(const TriangleMesh& mesh, const Vector3d& up) {
  return *std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                           [&](const Vector3d& a, const Vector3d& b) { return a.dot(up) < b.dot(up); });
}

/// The axis across up along which the top of the head is longer; the first one where both are alike.
Vector3d longer_way(const TriangleMesh& mesh, const Vector3d& up) {
  Eigen::AlignedBox3d box;
  const double lowest = highest(mesh, up).dot(up) - length_depth_mm;
  for (const Vector3d& p : mesh.vertices)
    if (p.dot(up) >= lowest) box.extend(p);
  Vector3d best = Vector3d::Zero();
  for (int c = 0; c < 3; ++c) {
    const Vector3d axis = Vector3d::Unit(c);
    if (axis.dot(up) == 0 && !(box.sizes().dot(best) >= box.sizes()[c])) best = axis;
  }
  return best;
}

Vector3d front_of(const TriangleMesh& mesh, const HeadPose& pose) {
  if (pose.front && pose.front->dot(pose.up) != 0)
    throw InvalidHead("front", "is along the same axis as `up`; give one across it");
  return pose.front ? *pose.front : longer_way(mesh, pose.up);
}

std::string text(const Vector3d& p) {
  const auto rounded = [](double x) { return number_text(std::round(10 * x) / 10); };
  return "[" + rounded(p.x()) + ", " + rounded(p.y()) + ", " + rounded(p.z()) + "]";
}

double distance_from(const TriangleMesh& mesh, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles)
    least = std::min(
        least,
        (nearest_on_triangle({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, p) - p).norm());
  return least;
}

/// The crown in the mesh's axes, near enough to the surface.
Vector3d crown_of(const TriangleMesh& mesh, const HeadPose& pose) {
  const Vector3d top = highest(mesh, pose.up);
  if (!pose.crown) return top;
  const double gap = distance_from(mesh, *pose.crown);
  if (!(gap <= crown_reach_mm))
    throw InvalidHead("crown", "is " + number_text(gap) +
                                   " mm from the mesh; give a point on it, in mm and in the " +
                                   "mesh's axes, or leave it out for the highest, " + text(top));
  return *pose.crown;
}

double squared_distance(const SectionChain& chain, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& q : chain.points) least = std::min(least, (q - p).squaredNorm());
  return least;
}

/// The points of a chain in line, those of a closed one cut open at the point farthest from p along it.
std::vector<Vector3d> opened(const SectionChain& chain, const Vector3d& p) {
  std::vector<Vector3d> points = chain.points;
  if (!chain.is_closed) return points;
  points.push_back(points.front());
  const SpaceCurve ring(points);
  const double across = std::fmod(ring.nearest(p) + ring.length() / 2, ring.length());
  const auto cut = std::lower_bound(ring.arcs().begin(), ring.arcs().end() - 1, across) - ring.arcs().begin();
  points.pop_back();
  std::rotate(points.begin(), points.begin() + cut % static_cast<std::ptrdiff_t>(points.size()),
              points.end());
  points.push_back(points.front());
  return points;
}

/// The chain of a section that passes nearest to p, 0 there, towards `along` at p.
SpaceCurve curve_through(const Vector3d& p, const Vector3d& along, const TriangleMesh& mesh,
                         const Plane& plane) {
  const auto chains = section(mesh, plane);
  const auto nearest = std::min_element(chains.begin(), chains.end(), [&](const auto& a, const auto& b) {
    return squared_distance(a, p) < squared_distance(b, p);
  });
  std::vector<Vector3d> points = opened(*nearest, p);
  const SpaceCurve one_way(points);
  if (one_way.direction(one_way.nearest(p), direction_reach_mm).dot(along) < 0)
    std::reverse(points.begin(), points.end());
  return SpaceCurve(points, -SpaceCurve(points).nearest(p));
}

void check_coverage(const Head& head) {
  const SpaceCurve across = cross_section(head, 0, direction_reach_mm);
  const std::array<std::pair<const char*, double>, 4> ways = {{{"back", -head.profile.first()},
                                                               {"front", head.profile.last()},
                                                               {"left", -across.first()},
                                                               {"right", across.last()}}};
  for (const auto& [way, reach] : ways)
    if (!(reach - rim_mm >= head.coverage_mm))
      throw InvalidHead("coverage_mm", "goes beyond the mesh: from the crown to the " + std::string(way) +
                                           " it can be followed for " +
                                           number_text(std::floor(reach - rim_mm)) +
                                           " mm; give at most that");
}

/// The mesh in mm, without what floats beside it.
TriangleMesh cleaned(const TriangleMesh& mesh, LengthUnit unit) {
  const TriangleMesh clean =
      without_fragments(moved(mesh, Eigen::Affine3d(Eigen::Scaling(mm_per(unit)))), fragment_gap_mm);
  check_size(clean, unit);
  return clean;
}

/// The place of the dome above or below the crown. @throws InvalidHead where it is open there
Vector3d top_of(const TriangleMesh& dome, const Vector3d& core) {
  const auto rise =
      dome.triangles.empty() ? std::nullopt : TriangleTree(dome).farthest_hit(core, Vector3d::UnitZ());
  if (!rise) throw InvalidHead("mesh", "has no surface at the crown: the top of the head is open to its rim");
  return core + *rise * Vector3d::UnitZ();
}

}  // namespace

double mm_per(LengthUnit unit) { return named(unit).mm; }

Head make_head(const TriangleMesh& mesh, const HeadPose& pose) {
  const TriangleMesh clean = cleaned(mesh, pose.unit);
  Eigen::Isometry3d to_mesh = Eigen::Isometry3d::Identity();
  to_mesh.linear() = axes_of(front_of(clean, pose), pose.up);
  to_mesh.translation() = crown_of(clean, pose);
  const Vector3d core(0, 0, -core_depth_mm);
  MeshDistance scan(moved(clean, Eigen::Affine3d(to_mesh.inverse())), core);
  const HeadDome dome = head_dome(scan.tree(), core);
  const Vector3d top = top_of(dome.mesh, core);
  const Plane sagittal(Vector3d::UnitX(), top);
  Head head{to_mesh,
            std::move(scan),
            MeshDistance(dome.mesh, core),
            curve_through(top, Vector3d::UnitY(), dome.mesh, sagittal),
            pose.coverage_mm,
            static_cast<double>(dome.closed) / static_cast<double>(dome.mesh.vertices.size())};
  check_coverage(head);
  return head;
}

SpaceCurve cross_section(const Head& head, double s, double reach) {
  const Vector3d p = head.profile.at(s);
  const Plane plane(head.profile.direction(s, reach), p);
  return curve_through(p, Vector3d::UnitX(), head.dome.mesh(), plane);
}

}  // namespace kinetix
