#pragma once

#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::optim {

/// Wanted scales of the walls of a planar structure, and the bounds of its hinges.
struct WallScales {
  /// Wanted 2 o of each wall (kinematics.md section 5), dimensionless. At theta a wall is scaled by
  /// cos(theta) - 2 o sin(theta).
  std::vector<double> wanted;
  double offset = 0.08;               ///< largest |o|, over a wall's length, (0, 0.5)
  double shift = 0.6;                 ///< largest |s| = |2 t - 1|, (0, 1)
  model::Axis axis = model::Axis::y;  ///< normal of the plates
  /// Vertices that stay on one line across the axis, as if gripped by plates; each vertex in one row at most.
  std::vector<std::vector<int>> straight = {};
  /// Distance by which the last row approaches the first in addition to cos(theta): drop sin(theta), cell
  /// edges. Plates then drive theta to its positive side.
  double drop = 0;

  /// @throws InvalidInput, naming the field, its value and its range
  void validate(const model::PlanarStructure& structure) const;
};

/// Returns the scales that a picture needs. Walls of a cell of level 1 are as large as `offset` allows, those
/// of level 0 as small. A wall between two cells has their mean.
/// @param levels of the structure's faces, [0, 1]
std::vector<double> wanted_scales(const std::vector<double>& levels, const model::PlanarStructure& structure,
                                  double offset);

/// Parallel drawing nearest to the wanted scales.
struct ScaledWalls {
  model::ParallelDrawing y;
  double distance = 0;  ///< rms difference of 2 o from `wanted`, dimensionless
  double offset = 0;    ///< largest |o| found, ratio to a wall's length
  double shift = 0;     ///< largest |s| found
  int iterations = 0;
  bool converged = false;  ///< bounds hold, and another iteration would change s and 2 o by less than 1e-6
};

/// Minimises the sum of (2 o - wanted)^2 over all parallel drawings y under |s| <= shift and |o| <= offset, a
/// convex problem. Each y is an exact motion with all hinges closed. The method alternates directions (Boyd
/// et al. 2011, section 5.2) between the separate walls and a graph Laplacian, factorised once.
ScaledWalls scale_walls(const model::PlanarStructure& structure, const WallScales& scales);

}  // namespace kinetix::optim
