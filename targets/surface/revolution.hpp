#pragma once

#include "targets/curve/curve.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::targets {

/// Smooth line of a surface of revolution: radius over height, mm. It is a natural cubic spline through its points,
/// which continues straight beyond them.
class Profile {
 public:
  /// @param points (radius, height), mm, heights ascending.
  /// @throws InvalidCurve naming the point for fewer than two points, heights that do not ascend, and radii that are
  /// not above 0 (at both ends: below 0). A spline that reaches the axis between two points also throws.
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

/// Makes a patch as seen from its front, with its axis along x. It is as wide as `arc` of its narrowest circle.
/// @param arc rad, (0, 120 deg]. @throws InvalidInput for arcs out of range and a profile that reaches the axis
SurfacePatch revolution_patch(const Profile& profile, double arc);

/// `arc` of a whole turn as triangles, mm: axis along x, middle of the arc towards z, origin on the axis half way up.
/// @param arc rad, (0, 2 pi]; closed round the axis at 2 pi. @throws InvalidInput for arcs out of range
TriangleMesh revolution_mesh(const Profile& profile, double arc);

/// Makes a ribbed surface with the spine along the middle of the arc. @throws InvalidInput as revolution_mesh
RibbedSurface ribbed_revolution(const Profile& profile, double arc);

}  // namespace kinetix::targets
