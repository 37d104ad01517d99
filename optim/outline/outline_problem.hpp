#pragma once

#include <stop_token>

#include "model/lattice/planar/planar_motion.hpp"
#include "optim/outline/panel_symmetry.hpp"
#include "optim/solvers/box_least_squares.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::optim {

/// Limits of turning and scaling of the walls of a panel.
struct WallBounds {
  std::vector<double> shift;   ///< of each wall: largest |s| = |2 t - 1|, in (0, 1)
  std::vector<double> offset;  ///< of each wall: largest |offset| over the wall's length, in [0, 0.5)
  /// Largest factor between a wall's flat length and a cell edge, either way, above 1. Used if the flat panel
  /// is free.
  std::vector<double> stretch;
};

/// Panel during the fit of its boundary to an outline. At theta its vertices are at X = cos(theta) x + i
/// sin(theta) y (kinematics.md section 5). Any X is therefore exact if every wall's ratio X_e / x_e is within
/// its bounds.
struct OutlineShape {
  std::vector<Eigen::Vector2d> flat;    ///< x, cell edges
  std::vector<Eigen::Vector2d> folded;  ///< X, cell edges
  double scale = 1;                     ///< mm of the folded outline per cell edge
};

/// Requirements on a panel at theta.
struct OutlineProblem {
  const model::PlanarStructure* panel = nullptr;  ///< its walls, faces and boundary
  std::vector<int> rim;                           ///< vertices of the outer boundary, counter-clockwise
  const targets::Outline* folded = nullptr;       ///< of the boundary at theta
  const targets::Outline* flat = nullptr;         ///< of the boundary at rest; null: x is fixed
  double flat_scale = 1;                          ///< mm of it per cell edge
  double theta = 0;                               ///< rad, in (0, pi/2)
  WallBounds bounds;
  std::vector<PanelSymmetry> symmetries = {};  ///< that the panel keeps; bounds have them, too
  std::stop_token stop = {};                   ///< on request, the iteration ends
};

/// Result of improve().
struct OutlineProgress {
  int rounds = 0;        ///< convex problems solved
  int iterations = 0;    ///< in all
  double moved = 0;      ///< largest move of a vertex in the last round, cell edges
  bool settled = false;  ///< nothing moved any more; otherwise stopped, or at the limit of rounds
};
/// Moves the boundary towards the outlines. Each round finds the nearest points again and solves a convex
/// problem, until nothing moves. The result is within bounds (to 1e-6). x is unchanged if `flat` is null.
/// @param spread first move the boundary's vertices to their places along the outlines (spread_along).
/// @param again only some bounds have changed since the last call, so that few rounds suffice
/// @param memory from the last call, or empty; updated for the next one
OutlineProgress improve(const OutlineProblem& problem, OutlineShape& shape, bool spread, bool again,
                        BoxLeastSquaresMemory& memory);

/// Returns the first place of each vertex of the boundary. Places along the outline have the boundary's own
/// proportions, shifted to be nearest to the present boundary.
std::vector<Eigen::Vector2d> spread_along(const targets::Outline& outline,
                                          const std::vector<Eigen::Vector2d>& rim);

/// Returns the parallel drawing y of a shape. @param theta rad
model::ParallelDrawing parallel_drawing_of(const OutlineShape& shape, double theta);

/// Returns the shape of a panel that deforms as another one with larger cells. Both panels at rest are laid over each
/// other, stretched to one bounding box. Places between vertices are interpolated linearly in triangles from the middle
/// of each cell to its walls.
/// @param coarse, fine panels at rest, cut from a lattice   @param shape of the coarse one
OutlineShape refined_shape(const model::PlanarStructure& coarse, const OutlineShape& shape,
                           const model::PlanarStructure& fine);

}  // namespace kinetix::optim
