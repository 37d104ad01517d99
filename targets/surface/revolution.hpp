#pragma once

#include "targets/curve/curve.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::targets {

/// The smooth line of a surface of revolution: radius over height, a natural cubic spline through its points, which goes
/// on straight beyond them. mm
class Profile {
 public:
  /// @param points (radius, height), mm, heights ascending
  /// @throws InvalidCurve naming the point: for less than two points, heights that do not ascend, radii that are not
  /// above 0 (at both ends: below 0), or a spline that comes to the axis between two points
  explicit Profile(std::vector<Eigen::Vector2d> points);

  /// Radius, mm, with its first and second derivative by height, at a height in mm.
  std::array<double, 3> radius(double height) const;
  double bottom() const { return points_.front().y(); }
  double top() const { return points_.back().y(); }
  /// Least and largest radius between bottom and top, mm.
  std::array<double, 2> radii() const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> bend_;  // second derivative at each point
};

/// Seen from its front, its axis along x: as wide as `arc` of its narrowest circle.
/// @param arc rad, (0, 120 deg]   @throws InvalidInput for arcs out of range and a profile that comes to the axis
SurfacePatch revolution_patch(const Profile& profile, double arc);

/// `arc` of a whole turn as triangles, mm: axis along x, middle of the arc towards z, origin on the axis half way up.
/// @param arc rad, (0, 2 pi]; closed round the axis at 2 pi. @throws InvalidInput for arcs out of range
TriangleMesh revolution_mesh(const Profile& profile, double arc);

/// With the spine along the middle of the arc. @throws InvalidInput as revolution_mesh
RibbedSurface ribbed_revolution(const Profile& profile, double arc);

}  // namespace kinetix::targets
