#pragma once

#include <vector>

#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::optim {

/// How far the walls of a planar structure shall scale, and what its hinges allow.
struct WallScales {
  /// Of each wall 2 o (kinematics.md section 5), dimensionless: at theta it is scaled by cos(theta) - 2 o
  /// sin(theta).
  std::vector<double> wanted;
  double offset = 0.08;               ///< largest |o|, over a wall's length, (0, 0.5)
  double shift = 0.6;                 ///< largest |s| = |2 t - 1|, (0, 1)
  model::Axis axis = model::Axis::y;  ///< normal of the plates
  /// Vertices that stay on one line across the axis, as plates grip them; each vertex in one row at most.
  std::vector<std::vector<int>> straight = {};
  double drop =
      0;  ///< the last row comes nearer to the first by drop sin(theta), cell edges, beside cos(theta):
          ///< plates then drive theta to its positive side

  /// @throws InvalidInput, naming the field, its value and its range
  void validate(const model::PlanarStructure& structure) const;
};

/// What a picture wants: the walls of a cell of level 1 as large as `offset` allows, of level 0 as small; a
/// wall between two cells takes their mean. @param levels of the structure's faces, [0, 1]
std::vector<double> wanted_scales(const std::vector<double>& levels, const model::PlanarStructure& structure,
                                  double offset);

/// The redrawing nearest to what is wanted.
struct ScaledWalls {
  model::Redrawing y;
  double distance = 0;  ///< rms of 2 o from what is wanted, dimensionless
  double offset = 0;    ///< largest |o| in fact, ratio to a wall's length
  double shift = 0;     ///< largest |s| in fact
  int iterations = 0;
  bool converged = false;  ///< bounds hold, and another iteration would change s and 2 o by less than 1e-6
};

/// Minimises the sum of (2 o - wanted)^2 over all redrawings y, each of which is an exact motion with all
/// hinges closed, under |s| <= shift and |o| <= offset: a convex problem. By alternating directions (Boyd et
/// al. 2011, section 5.2) between the walls, each by itself, and a Laplacian of the graph, factorised once.
ScaledWalls scale_walls(const model::PlanarStructure& structure, const WallScales& scales);

}  // namespace kinetix::optim
