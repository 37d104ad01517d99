#include "targets/surface/ribbed_surface.hpp"

#include <cmath>

#include "model/base/decompositions.hpp"
#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/mesh/mesh_section.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int patch_lines =
    96;  // lines per side of a patch: chords then deviate by 1e-4 from a one-radian arc.
// Least mean normal, as a fraction of the area, of a mesh that has a side to be seen from; half a sphere has 1/2.
constexpr double one_sided = 0.3;
// Distance below a mesh's middle, in its diagonals: from so far every part of an open mesh shows the same side.
constexpr double far_below = 10;
// Reach at each end of a closed section, as a fraction of its extent along y. Its ends are its highest places within
// that reach.
constexpr double near_end = 0.02;
// Difference of equal lengths, as a fraction of the longest section's. Of sections within it, such as both sides of a
// tube, the highest is taken.
constexpr double as_long = 0.01;
constexpr double same_place = 1e-9;  // fraction of a section's length: points that near are one

/// Area, centroid and spread of a mesh, by area.
struct Moments {
  double area = 0;
  Vector3d centre = Vector3d::Zero(), normal = Vector3d::Zero();  ///< mean normal, by area
  Matrix3d spread = Matrix3d::Zero();
};
Moments moments(const TriangleMesh& mesh) {
  Moments out;
  const auto middle = [&](std::size_t t, int k) {
    return Vector3d((mesh.corner(t, k) + mesh.corner(t, (k + 1) % 3)) / 2);
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d normal = area_normal(mesh, t) / 2;
    out.area += normal.norm();
    out.normal += normal;
    for (int k = 0; k < 3; ++k) out.centre += normal.norm() / 3 * mesh.corner(t, k);
  }
  if (!(out.area > 0)) throw InvalidInput("the mesh has no area");
  out.centre /= out.area;
  out.normal /= out.area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vector3d d = middle(t, k) - out.centre;
      out.spread += area_normal(mesh, t).norm() / 6 * d * d.transpose();
    }
  return out;
}

/// Returns the longest axis normal to z, with its largest component positive.
Vector3d longest_across(const Matrix3d& spread, const Vector3d& z) {
  const Matrix3d flat = Matrix3d::Identity() - z * z.transpose();
  Vector3d axis = symmetric_eigenvectors(flat * spread * flat).vectors.col(2);
  Eigen::Index most = 0;
  axis.cwiseAbs().maxCoeff(&most);
  if (axis[most] < 0) axis = -axis;
  return axis.normalized();
}

/// Returns x, y and z of the ribs' frame as rows, before the spine's ends are made level.
Matrix3d rough_frame(const Moments& of) {
  const bool has_side = of.normal.norm() > one_sided;
  const Vector3d z = has_side ? Vector3d(of.normal.normalized())
                              : Vector3d(symmetric_eigenvectors(of.spread).vectors.col(0));
  const Vector3d y = longest_across(of.spread, z);
  Matrix3d out;
  out << y.cross(z).transpose(), y.transpose(), z.transpose();
  return out;
}

TriangleMesh moved(TriangleMesh mesh, const Isometry3d& by) {
  for (Vector3d& p : mesh.vertices) p = by * p;
  return mesh;
}

double length_of(const SectionChain& chain) {
  double sum = 0;
  for (std::size_t k = 1; k < chain.points.size(); ++k) sum += (chain.points[k] - chain.points[k - 1]).norm();
  return sum;
}

double mean_height(const std::vector<Vector3d>& line) {
  double sum = 0, length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double step = (line[k] - line[k - 1]).norm();
    sum += step * (line[k].z() + line[k - 1].z()) / 2;
    length += step;
  }
  return sum / length;
}

/// Returns the part of a closed section over the top, between its highest places near its ends along y.
std::vector<Vector3d> over_the_top(const std::vector<Vector3d>& ring) {
  double least = INFINITY, most = -INFINITY;
  for (const Vector3d& p : ring) least = std::min(least, p.y()), most = std::max(most, p.y());
  const double reach = near_end * (most - least);
  std::size_t from = 0, to = 0;
  double from_z = -INFINITY, to_z = -INFINITY;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (ring[k].y() <= least + reach && ring[k].z() > from_z) from = k, from_z = ring[k].z();
    if (ring[k].y() >= most - reach && ring[k].z() > to_z) to = k, to_z = ring[k].z();
  }
  const auto half = [&](int step) {
    std::vector<Vector3d> out = {ring[from]};
    const auto count = static_cast<int>(ring.size());
    for (int k = static_cast<int>(from); k != static_cast<int>(to);)
      k = (k + step + count) % count, out.push_back(ring[k]);
    return out;
  };
  std::vector<Vector3d> one = half(1), other = half(-1);
  return mean_height(one) >= mean_height(other) ? one : other;
}

/// Returns the line of the spine in the plane x = 0.
std::vector<Vector3d> spine_over(const TriangleMesh& mesh) {
  const std::vector<SectionChain> chains = section(joined(mesh), Plane(Vector3d::UnitX(), 0));
  if (chains.empty()) throw InvalidInput("the mesh has nothing in the middle plane along its longest axis");
  double most = 0;
  for (const SectionChain& chain : chains) most = std::max(most, length_of(chain));
  const auto rank = [&](const SectionChain& chain) {
    return length_of(chain) < (1 - as_long) * most ? -INFINITY : mean_height(chain.points);
  };
  const SectionChain& longest = *std::max_element(
      chains.begin(), chains.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  std::vector<Vector3d> line = longest.is_closed ? over_the_top(longest.points) : longest.points;
  if (line.front().y() > line.back().y()) std::reverse(line.begin(), line.end());
  return line;
}

Isometry3d isometry(const Matrix3d& turn, const Vector3d& origin) {
  Isometry3d out = Isometry3d::Identity();
  out.linear() = turn;
  out.translation() = -turn * origin;
  return out;
}

RibbedSurface ribbed(const TriangleMesh& given, const Isometry3d& rough, bool has_side) {
  const std::vector<Vector3d> line = spine_over(moved(given, rough));
  const Vector3d chord = line.back() - line.front();
  const double rise = std::atan2(chord.z(), chord.y());
  const Matrix3d level = Eigen::AngleAxisd(-rise, Vector3d::UnitX()).toRotationMatrix();
  const Isometry3d frame = isometry(level, (line.front() + line.back()) / 2) * rough;
  std::vector<Vector3d> spine;
  for (const Vector3d& p : line) spine.push_back(frame * (rough.inverse() * p));
  TriangleMesh mesh = moved(given, frame);
  const double diagonal = bounds(given).diagonal().norm();
  const Vector3d inside = has_side ? Vector3d(0, 0, -far_below * diagonal) : Vector3d(bounds(mesh).center());
  return {MeshDistance(std::move(mesh), inside), SpaceCurve(spine), frame.inverse(), moments(given).area,
          diagonal};
}

}  // namespace

TriangleMesh patch_mesh(const SurfacePatch& patch) {
  TriangleMesh mesh;
  for (int j = 0; j <= patch_lines; ++j)
    for (int i = 0; i <= patch_lines; ++i) {
      const Vector2d at =
          patch.half.cwiseProduct(Vector2d(2.0 * i / patch_lines - 1, 2.0 * j / patch_lines - 1));
      mesh.vertices.emplace_back(at.x(), at.y(), patch.height(at).z);
    }
  for (int j = 0; j < patch_lines; ++j)
    for (int i = 0; i < patch_lines; ++i) {
      const int a = j * (patch_lines + 1) + i, b = a + patch_lines + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return mesh;
}

RibbedSurface ribbed_surface(const TriangleMesh& mesh) {
  const Moments of = moments(mesh);
  return ribbed(mesh, isometry(rough_frame(of), of.centre), of.normal.norm() > one_sided);
}

RibbedSurface ribbed_along_x(const TriangleMesh& mesh, bool has_side) {
  const Matrix3d turn = Eigen::AngleAxisd(pi / 2, Vector3d::UnitZ()).toRotationMatrix();
  return ribbed(mesh, isometry(turn, Vector3d::Zero()), has_side);
}

RibbedSurface ribbed_surface(const SurfacePatch& patch) {
  if (patch.half.x() >= patch.half.y()) return ribbed_along_x(patch_mesh(patch), true);
  return ribbed(patch_mesh(patch), Isometry3d::Identity(), true);
}

std::array<std::vector<Vector3d>, 2> section_from(const TriangleMesh& mesh, const Vector3d& p,
                                                  const Vector3d& normal) {
  const std::vector<SectionChain> chains = section(mesh, Plane(normal, p));
  double nearest = INFINITY, at = 0;
  std::vector<Vector3d> line;
  bool is_closed = false;
  for (const SectionChain& chain : chains) {
    std::vector<Vector3d> points = chain.points;
    if (chain.is_closed) points.push_back(points.front());
    if (!(length_of({points, false}) > 0)) continue;
    const SpaceCurve curve(points);
    const double arc = curve.nearest(p), apart = (curve.at(arc) - p).norm();
    if (!(apart < nearest)) continue;
    nearest = apart, at = arc, is_closed = chain.is_closed, line = std::move(points);
  }
  if (line.empty()) throw InvalidInput("a plane across the spine does not cut the mesh");
  const SpaceCurve curve(line);
  const double length = curve.length(), tiny = same_place * length;
  std::array<std::vector<Vector3d>, 2> arms;
  for (const int way : {0, 1}) {
    const double reach = is_closed ? length / 2 : way == 0 ? at : length - at;
    arms[way].push_back(curve.at(at));
    std::vector<double> arcs;
    for (const double arc : curve.arcs())
      for (const double round : {-length, 0.0, length}) {
        if (round != 0 && !is_closed) continue;
        const double away = (way == 0 ? -1 : 1) * (arc + round - at);
        if (away > tiny && away < reach - tiny) arcs.push_back(away);
      }
    if (reach > tiny) arcs.push_back(reach);
    std::sort(arcs.begin(), arcs.end());
    for (const double away : arcs) {
      double arc = at + (way == 0 ? -away : away);
      if (is_closed) arc -= length * std::floor(arc / length);
      arms[way].push_back(curve.at(arc));
    }
  }
  const auto reach_in_x = [](const std::vector<Vector3d>& arm) {
    return arm.size() > 1 ? (arm[1] - arm[0]).normalized().x() : 0;
  };
  if (reach_in_x(arms[0]) > reach_in_x(arms[1])) std::swap(arms[0], arms[1]);
  return arms;
}

}  // namespace kinetix::targets
