#pragma once

#include "targets/surface/surface_patch.hpp"

namespace kinetix::targets {

/// Points of a surface, row by row, (columns + 1) x (rows + 1) of them, mm.
struct PointGrid {
  int columns = 0, rows = 0;  ///< of the quadrilaterals between them, >= 1
  std::vector<Eigen::Vector3d> points;

  int points_per_row() const { return columns + 1; }
  const Eigen::Vector3d& at(int i, int j) const {
    return points[static_cast<std::size_t>(j) * points_per_row() + i];
  }
};

/// Computes the angle defect of each inner point of a grid, rad: 2 pi less the angles of the four quadrilaterals at
/// it. By the theorem of Gauss and Bonnet it is the integral of Gauss's curvature over the area nearest to that point.
/// Row by row, (columns - 1) x (rows - 1).
std::vector<double> angle_defects(const PointGrid& grid);

/// Integrates Gauss's curvature of a surface, sr, over a quadrilateral of the plane below it. The integral is the
/// signed solid angle that its normals sweep. It uses 9 points; corners counter-clockwise, mm.
double gauss_integral(const SurfacePatch& patch, const std::array<Eigen::Vector2d, 4>& corners);

/// Gauss's curvature of a sheet over a surface, against that of the surface below it.
struct GaussShare {
  double wanted = 0;  ///< integral of |K| over the whole surface, sr
  double share =
      0;  ///< of both signs the smaller one, [0, 1]; 0 of a grid without inner points over the surface; NaN of one that is not curved
};

/// Angle defects of a grid over the integrals of K of the surface below each of its inner points, over those where K
/// is positive and over those where it is negative. A sign counts where its integral exceeds 0.05 sr, or is the larger one.
/// @param middle of the folded sheet, in the frame of the surface. Points beyond its rim are left out
GaussShare gauss_share(const SurfacePatch& surface, const PointGrid& middle);

/// Integral of |K| above which a surface counts as curved both ways, sr.
inline constexpr double double_curvature_threshold = 0.1;

}  // namespace kinetix::targets
