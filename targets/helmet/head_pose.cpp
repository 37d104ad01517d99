#include "targets/helmet/head_pose.hpp"

#include <algorithm>
#include <cmath>

#include "targets/document/length_unit.hpp"
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
/// Distance from the crown, mm, up to which a whole body is taken: below it are the shoulders.
constexpr double body_reach_mm = 300;

/// @param mesh in mm
void check_size(const TriangleMesh& mesh, double unit_mm) {
  const double size = bounds(mesh).sizes().maxCoeff();
  if (size >= min_head_mm && size <= max_body_mm) return;
  throw InvalidHead("units", "the mesh is " + number_text(size) + " mm long, and a head or a bust is " +
                                 number_text(min_head_mm) + " to " + number_text(max_head_mm) + " mm. " +
                                 advise_unit(size / unit_mm, usual_head_mm, min_head_mm, max_head_mm) +
                                 ", or the length of the head by `head_mm`");
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

TriangleMesh head_mesh(const TriangleMesh& mesh, double unit_mm) {
  TriangleMesh scaled = mesh;
  for (Vector3d& p : scaled.vertices) p *= unit_mm;
  check_size(scaled, unit_mm);
  const TriangleMesh head = without_fragments(scaled, fragment_gap_mm);
  check_size(head, unit_mm);
  return head;
}

TriangleMesh near_crown(const TriangleMesh& mesh, const Vector3d& up) {
  if (!(bounds(mesh).sizes().maxCoeff() > max_head_mm)) return mesh;
  const Vector3d crown = highest(mesh, up);
  TriangleMesh near{mesh.vertices, {}};
  for (const Triangle& t : mesh.triangles) {
    const auto is_near = [&](int v) { return (mesh.vertices[v] - crown).norm() <= body_reach_mm; };
    if (is_near(t[0]) && is_near(t[1]) && is_near(t[2])) near.triangles.push_back(t);
  }
  return joined(near);
}

namespace {

/// Parts of a mesh above levels below its top, along one direction.
class UpperParts {
 public:
  UpperParts(const TriangleMesh& mesh, const Vector3d& up) : mesh_(mesh), up_(up) {
    for (const Vector3d& p : mesh.vertices) height_.push_back(p.dot(up));
    for (const Triangle& t : mesh.triangles)
      for (const int v : t) top_ = std::max(top_, height_[v]);
  }

  /// Returns the longer and the shorter side, across `up`, of the box of the part above a depth.
  std::array<double, 2> sides(double depth) const {
    const double level = top_ - depth;
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh_.triangles)
      for (int k = 0; k < 3; ++k) {
        const int a = t[k], b = t[(k + 1) % 3];
        if (height_[a] >= level) box.extend(mesh_.vertices[a]);
        if ((height_[a] >= level) == (height_[b] >= level)) continue;
        const double part = (level - height_[a]) / (height_[b] - height_[a]);
        box.extend(Vector3d((1 - part) * mesh_.vertices[a] + part * mesh_.vertices[b]));
      }
    const Vector3d across = box.isEmpty() ? Vector3d(Vector3d::Zero())
                                          : Vector3d(box.sizes() - up_.cwiseAbs().cwiseProduct(box.sizes()));
    const double longer = across.maxCoeff();
    return {longer, across.sum() - longer};
  }

 private:
  const TriangleMesh& mesh_;
  const Vector3d up_;
  std::vector<double> height_;
  double top_ = -std::numeric_limits<double>::infinity();
};

// Semi-axes of a usual head, over its length: half its length, half its breadth, and the height above the level at
// which it is longest. They are those of targets/shapes/generate_headform.py.
constexpr double half_length = 0.5, half_breadth = 0.39, upper_height = 0.49;
constexpr double depth_of_length = 0.5;             // of the length: above nose and ears
constexpr double levels[] = {0.03, 0.1, 0.2, 0.4};  // depths at which sections are compared, over the length
constexpr double head_misfit = 0.1;                 // most of a head: other things have no axis of a head
constexpr double clear_difference = 0.12;  // of misfits: the axis must fit better than all others by this
constexpr double one_sided_normal =
    0.3;  // mean normal over the area, from which a mesh shows one side; half a sphere has 1/2

/// Returns the mean logarithm of the ratios of sizes of sections below the top to those of a usual head.
double misfit_of(const TriangleMesh& mesh, const Vector3d& up) {
  const double length = head_length(mesh, up);
  if (!(length > 0)) return std::numeric_limits<double>::infinity();
  const UpperParts parts(mesh, up);
  double sum = 0;
  for (const double depth : levels) {
    const double rest = 1 - std::min(depth / upper_height, 1.0), share = std::sqrt(1 - rest * rest);
    const auto [longer, shorter] = parts.sides(depth * length);
    sum += std::abs(std::log(longer / (2 * half_length * share * length)));
    sum += std::abs(std::log(std::max(shorter, 1e-6 * length) / (2 * half_breadth * share * length)));
  }
  return sum / (2 * static_cast<double>(std::size(levels)));
}

}  // namespace

double head_length(const TriangleMesh& mesh, const Vector3d& up) {
  const UpperParts parts(mesh, up);
  double lower = 0, upper = bounds(mesh).sizes().norm();
  for (int k = 0; k < 40; ++k) {
    const double middle = (lower + upper) / 2;
    (parts.sides(depth_of_length * middle)[0] > middle ? lower : upper) = middle;
  }
  return (lower + upper) / 2;
}

Vector3d likely_up(const TriangleMesh& mesh) {
  Vector3d best = Vector3d::UnitZ();
  double least = std::numeric_limits<double>::infinity(), second = least;
  for (int k = 0; k < 6; ++k) {
    const Vector3d up = (k < 3 ? 1 : -1) * Vector3d::Unit(k % 3);
    const double misfit = misfit_of(mesh, up);
    if (misfit < least) {
      second = std::exchange(least, misfit);
      best = up;
    } else {
      second = std::min(second, misfit);
    }
  }
  return least <= head_misfit && second - least >= clear_difference ? best : Vector3d(Vector3d::UnitZ());
}

bool is_face_scan(const TriangleMesh& mesh, const Vector3d& up) {
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d normal = area_normal(mesh, t);
    sum += normal;
    area += normal.norm();
  }
  const double across = (sum - sum.dot(up) * up).norm();
  return across > one_sided_normal * area && across > std::abs(sum.dot(up));
}

Eigen::Isometry3d head_frame(const TriangleMesh& mesh, const HeadPose& pose) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = axes_of(front_of(mesh, pose), pose.up);
  frame.translation() = crown_of(mesh, pose);
  return frame;
}

}  // namespace kinetix::targets
