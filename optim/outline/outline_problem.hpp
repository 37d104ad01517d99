#pragma once

#include <array>
#include <stop_token>
#include <vector>

#include "model/lattice/planar/planar_motion.hpp"
#include "optim/solvers/box_least_squares.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::optim {

/// How far the walls of a panel may turn and scale.
struct WallBounds {
  std::vector<double> shift;   ///< of each wall: largest |s| = |2 t - 1|, in (0, 1)
  std::vector<double> offset;  ///< likewise largest |offset| over the wall's length, in [0, 0.5)
  /// Where the flat panel is free: largest factor between its length and a cell edge, either way, above 1.
  std::vector<double> stretch;
};

/// A panel while its rim is fitted to an outline. At theta its vertices are at X = cos(theta) x + i sin(theta) y
/// (kinematics.md section 5), so that any X is exact where every wall's ratio X_e / x_e keeps to its bounds.
struct OutlineShape {
  std::vector<Eigen::Vector2d> flat;    ///< x, cell edges
  std::vector<Eigen::Vector2d> folded;  ///< X, cell edges
  double scale = 1;                     ///< mm of the folded outline a cell edge
};

/// What is asked of a panel at theta.
struct OutlineProblem {
  const model::PlanarStructure* panel = nullptr;  ///< its walls, faces and rim
  std::vector<int> rim;                           ///< vertices round the outside, counter-clockwise
  const targets::Outline* folded = nullptr;       ///< of the rim at theta
  const targets::Outline* flat = nullptr;         ///< of the rim at rest; nothing: x is as it is
  double flat_scale = 1;                          ///< mm of it a cell edge
  double theta = 0;                               ///< rad, in (0, pi/2)
  WallBounds bounds;
  std::stop_token stop = {};  ///< where it asks to, nothing more is brought nearer
};

/// Brings the rim nearer to the outlines: nearest points are taken anew, and a convex problem is solved, until
/// nothing moves. Bounds hold at its end (to 1e-6), with x as it came where `flat` is nothing.
struct OutlineProgress {
  int rounds = 0;        ///< convex problems solved
  int iterations = 0;    ///< in all
  double moved = 0;      ///< largest of a vertex in the last round, cell edges
  bool settled = false;  ///< nothing moved any more; else it took as many rounds as it may, or was stopped
};
/// @param spread first send the rim's vertices to their places along the outlines (spread_along)
/// @param memory of the last time, or empty; kept for the next one
OutlineProgress improve(const OutlineProblem& problem, OutlineShape& shape, bool spread,
                        BoxLeastSquaresMemory& memory);

/// Where each vertex of the rim belongs at first: along the outline in the rim's own proportions, from where it
/// is nearest to the rim as it stands.
std::vector<Eigen::Vector2d> spread_along(const targets::Outline& outline,
                                          const std::vector<Eigen::Vector2d>& rim);

/// The redrawing y of a shape. @param theta rad
model::Redrawing redrawing_of(const OutlineShape& shape, double theta);

}  // namespace kinetix::optim
