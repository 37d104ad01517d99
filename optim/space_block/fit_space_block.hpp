#pragma once

#include "model/base/geometry.hpp"
#include "model/lattice/sodalite.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/space_block/space_block_goal.hpp"

namespace kinetix::optim {

/// Options of the search for a block.
struct SpaceBlockVariables {
  std::optional<std::array<int, 3>> cells = {};  ///< cubic cells along x, y, z; unset: from the size
  std::optional<double> edge_mm = {};            ///< of the net; unset: from the size
  AngleRange theta = {5 * radians_per_degree, 44 * radians_per_degree};  ///< rad, (0, pi/4)
  std::array<double, 2> gusset = {0.1, 0.8};  ///< lengths of gussets over the edge, in [0.02, 0.9]
};

/// Explains why no block with these ranges shrinks by these factors; empty if one does. With gussets of
/// length g_n in the squares normal to n = x, y, z, edges there shrink by (1 - g_n) sin(theta)^2 of their
/// length. A direction shrinks by the mean of the two kinds of edges along it (kinematics.md section 8).
std::string obstacle(const targets::SpaceBlockGoal& goal, const SpaceBlockVariables& variables);

/// Returns the length of a cubic cell of the sodalite net over its edge: sqrt(8).
double cubic_cell();

/// A block of rotors and gussets, found in closed form.
struct SpaceBlockDesign {
  std::array<int, 3> cells = {};
  double edge_mm = 0;
  Eigen::Vector3d gusset;  ///< over the edge: of edges in squares normal to x, y and z
  double theta = 0;        ///< rad, > 0
  double size_off = 0;     ///< largest difference of a rest length from the requested one, ratio; 0: none
  Eigen::Vector3d size_mm = {0, 0, 0};  ///< at rest
};

/// Finds a block. The shortest gussets are a fifth of the edge, or as near to it as the ranges of theta and
/// the gussets allow. Without cells and edge, it uses the fewest cells along the shortest side, two to five,
/// with all lengths within `enough` of the requested size. If none are, the nearest are used.
/// @param enough over a length, >= 0   @pre no obstacle; all of `variables` are in their ranges
SpaceBlockDesign fit_space_block(const targets::SpaceBlockGoal& goal, const SpaceBlockVariables& variables,
                                 double enough);

/// Builds the lattice. @param size with the design's edge
model::SodaliteStructure block_of(const SpaceBlockDesign& design, const model::CellSize& size);

/// Returns the rotors of the six sides: the outermost ones.
std::array<std::array<std::vector<int>, 2>, 3> side_rotors(const model::SodaliteStructure& block);
/// Returns their positions in a state, mm.
targets::BlockSides block_sides(const model::SodaliteStructure& block, const model::State& state);

}  // namespace kinetix::optim
