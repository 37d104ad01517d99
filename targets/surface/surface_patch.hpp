#pragma once

#include <functional>
#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// Height of a surface over a point of a plane, with its first and second derivatives by it.
struct Height {
  double z = 0;                                       ///< mm
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();    ///< mm per mm
  Eigen::Matrix2d bending = Eigen::Matrix2d::Zero();  ///< 1 / mm
};

/// Open, smooth surface as heights over a rectangle about the origin, mm. It continues beyond the rectangle by about a
/// fifth, so that points near its boundary also have a distance.
struct SurfacePatch {
  std::string name;
  Eigen::Vector2d half = {1, 1};                         ///< sides of the rectangle, halved, mm, > 0
  std::function<Height(const Eigen::Vector2d&)> height;  ///< smooth

  /// Returns the diagonal of the box round the surface over the rectangle, mm.
  double diagonal() const;
};

/// The place of a surface nearest to a point, from a start right below it.
struct ClosestSurfacePoint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();       ///< below the place, mm
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit normal of the surface there, upwards
  double distance = 0;                                ///< along the normal, mm; > 0 above
};
ClosestSurfacePoint closest_surface_point(const SurfacePatch& patch, const Eigen::Vector3d& p);

/// Principal curvatures, 1 / mm, the larger magnitude first. Positive where it bends upwards.
std::array<double, 2> principal_curvatures(const Height& height);

/// How strongly a surface curves, over a grid of places.
struct SurfaceCurvature {
  double most = 0;   ///< largest principal curvature, 1 / mm, >= 0
  double total = 0;  ///< integral of the magnitude of Gauss's curvature, dimensionless
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< of the largest, mm
};
SurfaceCurvature curvature_of(const SurfacePatch& patch);

/// The cap of a sphere that `arc` of a great circle spans, over the square in its rim: normals turn by `arc` from
/// corner to corner. @param width of the square, mm, > 0   @param arc rad, (0, 140 deg]. @throws InvalidInput
SurfacePatch cap_patch(double width, double arc);

/// z = rise (x^2 - y^2) / half of the width, |x|, |y| at most that half. @param rise in (0, 1]
/// @throws InvalidInput
SurfacePatch saddle_patch(double width, double rise);

/// Part of a vase seen from its front, its axis along x: radius + swell sin(pi x / half of the height), as wide as `arc`
/// of its mean circle. Curved like a ball at its belly, like a saddle at its neck. @param arc rad, (0, 120 deg]
/// @throws InvalidInput, among others where the front is nearly as wide as the neck or wider
SurfacePatch vase_patch(double height, double radius, double swell, double arc);

/// A surface of revolution from its front, its axis along x at z = -level. @param radius with its first and second
/// derivative by x, mm   @param level mm, > 0: about the radius   @param narrowest mm, > 0: the least radius, above half.y()
SurfacePatch round_patch(const std::string& name, const Eigen::Vector2d& half, double level, double narrowest,
                         const std::function<std::array<double, 3>(double)>& radius);

/// Fits an open mesh by heights over its mean plane. The mean of its normals is z, the side of the least rectangle
/// round it x, and the middle of that rectangle the origin. Heights are one smooth polynomial through its vertices.
/// The rectangle is shrunk to the area of the mesh, so that round meshes are not evaluated outside their boundary.
/// @throws InvalidInput for a mesh that is closed, covers itself, has holes, several pieces or edges of more than two
/// triangles. It also throws for a mesh that turns by 80 deg or more from its mean normal, or is not smooth (the
/// polynomial misses it).
SurfacePatch mesh_patch(const TriangleMesh& mesh);

}  // namespace kinetix::targets
