#include "targets/surface/revolution.hpp"

#include <cmath>

#include "model/base/geometry.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int samples_per_piece =
    16;  // between two points of a profile, where a cubic is at its least to 1 %
constexpr int mesh_rings = 96, mesh_sides = 128;            // chords leave 3e-4 of the radius
constexpr double max_patch_arc = 120 * radians_per_degree;  // rims then rise by 60 deg
constexpr double whole_turn_slack = 1e-9;                   // rad: rounding of degrees

void require_arc(double arc, double most, const char* rule) {
  require("arc_deg", to_degrees(arc), arc > 0 && arc <= most + whole_turn_slack, rule);
}

/// Second derivatives of the natural cubic spline through (value, place): zero at both ends, and continuous slope.
std::vector<double> natural_spline(const std::vector<Vector2d>& points) {
  const auto step = [&](std::size_t k) { return points[k + 1].y() - points[k].y(); };
  const auto slope = [&](std::size_t k) { return (points[k + 1].x() - points[k].x()) / step(k); };
  std::vector<double> bend(points.size(), 0), above(points.size(), 0);
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const double pivot = 2 * (step(k - 1) + step(k)) - step(k - 1) * above[k - 1];
    above[k] = step(k) / pivot;
    bend[k] = (6 * (slope(k) - slope(k - 1)) - step(k - 1) * bend[k - 1]) / pivot;
  }
  for (std::size_t k = points.size() - 1; k-- > 1;) bend[k] -= above[k] * bend[k + 1];
  return bend;
}

}  // namespace

Profile::Profile(std::vector<Vector2d> points) : points_(std::move(points)) {
  if (points_.size() < 2) throw InvalidCurve("a profile needs at least two points", -1);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (!(points_[k].x() > 0))
      throw InvalidCurve("the radius, " + number_text(points_[k].x()) + " mm, must be above 0",
                         static_cast<int>(k));
    if (k > 0 && !(points_[k].y() > points_[k - 1].y()))
      throw InvalidCurve("the heights of a profile do not ascend: " + number_text(points_[k].y()) +
                             " mm follows " + number_text(points_[k - 1].y()) + " mm. Give ascending heights",
                         static_cast<int>(k));
  }
  bend_ = natural_spline(points_);
  for (std::size_t k = 0; k + 1 < points_.size(); ++k)
    for (int look = 1; look < samples_per_piece; ++look) {
      const double part = static_cast<double>(look) / samples_per_piece;
      if (!(radius((1 - part) * points_[k].y() + part * points_[k + 1].y())[0] > 0))
        throw InvalidCurve(
            "the smooth line through the points reaches the axis before this one. Give more points",
            static_cast<int>(k + 1));
    }
}

std::array<double, 3> Profile::radius(double height) const {
  const auto last = points_.size() - 2;
  const auto next = std::upper_bound(points_.begin() + 1, points_.end() - 1, height,
                                     [](double z, const Vector2d& p) { return z < p.y(); });
  const auto k = std::min(static_cast<std::size_t>(next - points_.begin()) - 1, last);
  const double h = points_[k + 1].y() - points_[k].y();
  const double from = std::clamp(height, bottom(), top()), a = (points_[k + 1].y() - from) / h, b = 1 - a;
  const double value = a * points_[k].x() + b * points_[k + 1].x() +
                       ((a * a * a - a) * bend_[k] + (b * b * b - b) * bend_[k + 1]) * h * h / 6;
  const double slope = (points_[k + 1].x() - points_[k].x()) / h +
                       ((1 - 3 * a * a) * bend_[k] + (3 * b * b - 1) * bend_[k + 1]) * h / 6;
  if (height != from) return {value + slope * (height - from), slope, 0};
  return {value, slope, a * bend_[k] + b * bend_[k + 1]};
}

std::array<double, 2> Profile::radii() const {
  std::array<double, 2> out = {INFINITY, 0};
  const int looks = samples_per_piece * static_cast<int>(points_.size() - 1);
  for (int look = 0; look <= looks; ++look) {
    const double r = radius(bottom() + (top() - bottom()) * look / looks)[0];
    out = {std::min(out[0], r), std::max(out[1], r)};
  }
  return out;
}

SurfacePatch revolution_patch(const Profile& profile, double arc) {
  require_arc(arc, max_patch_arc, "in (0, 120] deg");
  const double middle = (profile.bottom() + profile.top()) / 2;
  const double half = (profile.top() - profile.bottom()) / 2, narrowest = profile.radii()[0];
  return round_patch("profile", {half, narrowest * std::sin(arc / 2)}, profile.radius(middle)[0], narrowest,
                     [profile, middle](double x) { return profile.radius(middle + x); });
}

TriangleMesh revolution_mesh(const Profile& profile, double arc) {
  require_arc(arc, 2 * pi, "in (0, 360] deg");
  const bool closed = arc > 2 * pi - whole_turn_slack;
  const int around = closed ? mesh_sides : mesh_sides + 1;
  const double middle = (profile.bottom() + profile.top()) / 2;
  TriangleMesh mesh;
  for (int ring = 0; ring <= mesh_rings; ++ring) {
    const double z = profile.bottom() + (profile.top() - profile.bottom()) * ring / mesh_rings;
    const double r = profile.radius(z)[0];
    for (int side = 0; side < around; ++side) {
      const double angle = arc * (static_cast<double>(side) / mesh_sides - 0.5);
      mesh.vertices.emplace_back(z - middle, -r * std::sin(angle), r * std::cos(angle));
    }
  }
  for (int ring = 0; ring < mesh_rings; ++ring)
    for (int side = 0; side < mesh_sides; ++side) {
      const int a = ring * around + side, b = ring * around + (side + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  return mesh;
}

RibbedSurface ribbed_revolution(const Profile& profile, double arc) {
  return ribbed_along_x(revolution_mesh(profile, arc), arc < pi);
}

}  // namespace kinetix::targets
