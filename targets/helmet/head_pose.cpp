#include "targets/helmet/head_pose.hpp"

#include <algorithm>
#include <cmath>

#include "targets/mesh/triangle_tree.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// Gap, mm, beyond which parts are separate from the head: wider than the cracks between the triangles of a scan.
constexpr double fragment_gap_mm = 5;
/// Depth below the top, mm, down to which the longer axis of a head is measured: above nose and ears.
constexpr double length_depth_mm = 60;
/// Largest side, mm, of the box of a usual head. The unit that comes nearest to it is suggested.
constexpr double usual_head_mm = 250;
struct NamedUnit {
  LengthUnit unit;
  const char* name;
  double mm;
};
/// Names of the key `units`, and the mm in each.
constexpr std::array<NamedUnit, 4> units = {{{LengthUnit::mm, "mm", 1},
                                             {LengthUnit::cm, "cm", 10},
                                             {LengthUnit::m, "m", 1000},
                                             {LengthUnit::inch, "in", 25.4}}};

const NamedUnit& named(LengthUnit unit) {
  return *std::find_if(units.begin(), units.end(), [&](const NamedUnit& u) { return u.unit == unit; });
}

bool is_size_of_head(double mm) { return mm >= min_head_mm && mm <= max_head_mm; }

/// Returns advice for a mesh of this size in the file's units.
std::string remedy(double size) {
  const auto strangeness = [&](const NamedUnit& u) {
    return std::abs(std::log(size * u.mm / usual_head_mm));
  };
  const auto best = std::min_element(units.begin(), units.end(), [&](const NamedUnit& a, const NamedUnit& b) {
    return strangeness(a) < strangeness(b);
  });
  if (!is_size_of_head(size * best->mm)) return ", with any of the units mm, cm, m and in. Scale the mesh";
  return ". Give `units: " + std::string(best->name) + "` for " + number_text(size * best->mm) + " mm";
}

/// @param mesh in mm
void check_size(const TriangleMesh& mesh, LengthUnit unit) {
  const double size = bounds(mesh).sizes().maxCoeff();
  if (is_size_of_head(size)) return;
  throw InvalidHead("units", "in " + std::string(named(unit).name) + " the mesh is " + number_text(size) +
                                 " mm long, and a head or a bust is " + number_text(min_head_mm) + " to " +
                                 number_text(max_head_mm) + " mm" + remedy(size / mm_per(unit)));
}

/// Returns the head frame's axes in those of the mesh, as columns.
Eigen::Matrix3d axes_of(const Vector3d& front, const Vector3d& up) {
  Eigen::Matrix3d axes;
  axes << front.cross(up), front, up;
  return axes;
}

const Vector3d& highest(const TriangleMesh& mesh, const Vector3d& up) {
  return *std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                           [&](const Vector3d& a, const Vector3d& b) { return a.dot(up) < b.dot(up); });
}

/// Returns the axis across up along which the top of the head is longer; ties go to the first one.
Vector3d longer_direction(const TriangleMesh& mesh, const Vector3d& up) {
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
    throw InvalidHead("front", "the direction is parallel to `up`. Give a perpendicular one");
  return pose.front ? *pose.front : longer_direction(mesh, pose.up);
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

/// Returns the crown in the mesh's axes. @throws InvalidHead if it is too far from the surface
Vector3d crown_of(const TriangleMesh& mesh, const HeadPose& pose) {
  const Vector3d top = highest(mesh, pose.up);
  if (!pose.crown) return top;
  const double gap = distance_from(mesh, *pose.crown);
  if (!(gap <= crown_reach_mm))
    throw InvalidHead("crown", "is " + number_text(gap) +
                                   " mm from the mesh. Give a point on it, in mm and in the " +
                                   "mesh's axes, or remove the key for the highest, " + text(top));
  return *pose.crown;
}

}  // namespace

double mm_per(LengthUnit unit) { return named(unit).mm; }

TriangleMesh head_mesh(const TriangleMesh& mesh, LengthUnit unit) {
  TriangleMesh scaled = mesh;
  for (Vector3d& p : scaled.vertices) p *= mm_per(unit);
  const TriangleMesh head = without_fragments(scaled, fragment_gap_mm);
  check_size(head, unit);
  return head;
}

Eigen::Isometry3d head_frame(const TriangleMesh& mesh, const HeadPose& pose) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = axes_of(front_of(mesh, pose), pose.up);
  frame.translation() = crown_of(mesh, pose);
  return frame;
}

}  // namespace kinetix::targets
