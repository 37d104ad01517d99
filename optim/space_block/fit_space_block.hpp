#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/base/angle.hpp"
#include "model/lattice/sodalite/sodalite.hpp"
#include "optim/solvers/variables.hpp"
#include "targets/space_block/space_block_goal.hpp"

namespace kinetix::optim {

/// What a search for a block may choose.
struct SpaceBlockVariables {
  std::optional<std::array<int, 3>> cells = {};  ///< cubic cells along x, y, z; nothing: as the size asks
  std::optional<double> edge_mm = {};            ///< of the net; nothing: as the size asks
  AngleRange theta = {5 * radians_per_degree, 44 * radians_per_degree};  ///< rad, (0, pi/4)
  std::array<double, 2> gusset = {0.1, 0.8};  ///< lengths of gussets over the edge, in [0.02, 0.9]
};

/// Why no block with these ranges shrinks by these factors; empty where one does. With gussets of length g_n in the squares
/// normal to n = x, y, z, edges there shrink by (1 - g_n) sin(theta)^2 of their length, and a direction by the mean of the
/// two that lie along it (kinematics.md section 8).
std::string obstacle(const targets::SpaceBlockGoal& goal, const SpaceBlockVariables& variables);

/// The length of a cubic cell of the sodalite net, over its edge: sqrt(8).
double cubic_cell();

/// A block of rotors and gussets, found in closed form.
struct SpaceBlockDesign {
  std::array<int, 3> cells = {};
  double edge_mm = 0;
  Eigen::Vector3d gusset;  ///< over the edge: of edges in squares normal to x, y and z
  double theta = 0;        ///< rad, > 0
  double size_off = 0;  ///< largest difference of a length at rest from the one asked for, ratio; 0: none was
  Eigen::Vector3d size_mm = {0, 0, 0};  ///< at rest
};

/// The shortest gussets are a fifth of the edge, or as near to it as theta and all gussets stay in their ranges. Without cells and edge, the fewest
/// cells along the shortest side, two to five, that keep all lengths to `enough` of what was asked, else those that come
/// nearest.
/// @param enough over a length, >= 0   @pre no obstacle; all of `variables` are in their ranges
SpaceBlockDesign fit_space_block(const targets::SpaceBlockGoal& goal, const SpaceBlockVariables& variables,
                                 double enough);

/// The lattice. @param size with the design's edge
model::SodaliteStructure block_of(const SpaceBlockDesign& design, const model::CellSize& size);

/// Rotors of the six sides: those furthest out.
std::array<std::array<std::vector<int>, 2>, 3> side_rotors(const model::SodaliteStructure& block);
/// Where they are in a state, mm.
targets::BlockSides block_sides(const model::SodaliteStructure& block, const model::State& state);

}  // namespace kinetix::optim
