#pragma once

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Target poses of the bodies of a structure.
struct Pull {
  State to;           ///< target poses, mm; one per body
  bool turns = true;  ///< true: positions and rotations; false: only positions
};

/// Distance of the points at which a body is pulled from its center, cell edges. It weights turns more than shifts.
/// Between two closed tilings, tiles must move apart and return, and a pull with more weight on shifts would block
/// them.
inline constexpr double pull_arm = 2;
/// Returns these points: the corners of a regular tetrahedron about the center, or the center alone. Cell edges, in
/// the rest frame.
std::vector<Eigen::Vector3d> pull_points(bool turns);

/// Returns the pull after a rigid motion that minimises its distance from rest. Relative target positions are
/// unchanged.
Pull aligned_pull(const Linkage& linkage, Pull pull);

/// Returns the pull at a share of the path from rest: each body moves straight and about one axis. @param share in
/// [0, 1]
Pull pull_at(const Linkage& linkage, const Pull& pull, double share);

struct DeploymentOptions {
  double turn = 0.17;    ///< largest turn of the pull on a body per step, rad, > 0: ten degrees
  double shift = 0.25;   ///< largest shift of the pull on a body per step, cell edges, > 0
  double closed = 1e-9;  ///< cell edges and rad, > 0: misfit of a hinge up to which a state is closed
  /// Cell edges and rad, > 0: misfit allowed if a hinge cannot close; the simulation's limit
  double limit = 2e-3;
  int iterations = 100;             ///< per step, >= 1
  std::function<bool()> stop = {};  ///< returns true to stop; called between steps
};

/// Motion of a structure of rigid bodies under a pull.
struct Deployment {
  std::vector<State> states;   ///< closed ones, rest first, mm
  std::vector<double> shares;  ///< share of the path of each state, 0 to 1
  double gap = 0;              ///< largest joint separation during the motion, cell edges
  double axis_gap = 0;         ///< largest mismatch of hinge axes during the motion, rad
  bool reached = false;        ///< true: the whole path is closed
  /// Rms distance of the last state from the pull, at points half a cell edge from centers, cell edges
  double off_rms = 0;
  double off_max = 0;  ///< largest distance at these points, cell edges
};

/// Computes states from rest along the pull, closed within the limit. Each state minimises the sum of squared
/// distances of the pulled points at its share of the path, with all hinges closed. It is found from the one before.
/// The method of multipliers uses Gauss-Newton steps on the closure equations, and allows redundant hinges. If a
/// structure has several motions, the result is one of many: the one that springs at these points would give.
/// @pre one pose per body in `pull`, all finite
Deployment deploy(const Linkage& linkage, const Pull& pull, const DeploymentOptions& options = {});

/// Returns half the mean turn of the hinges of a state, without sign, rad, >= 0. It replaces theta for pulled bodies.
double mean_half_turn(const Linkage& linkage, const State& state);

}  // namespace kinetix::model
