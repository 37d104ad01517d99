#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Where the bodies of a structure are pulled to.
struct Pull {
  State to;           ///< mm; one pose a body
  bool turns = true;  ///< also to the rotations of these poses; else only to their positions
};

/// Distance of the points at which a body is pulled from its center, cell edges. Turns count more than shifts by it: on their way
/// from one closed tiling to another, tiles have to move apart and come back, and a pull that minds shifts more holds them there.
inline constexpr double pull_arm = 2;
/// These points: the corners of a regular tetrahedron about the center, or the center alone. Cell edges, in the rest frame.
std::vector<Eigen::Vector3d> pull_points(bool turns);

/// A pull that moves the structure as little as it can as a whole: that of the same places and of the way to them.
Pull aligned_pull(const Linkage& linkage, Pull pull);

/// The pull on the way there: from rest, straight on and about one axis a body. @param share in [0, 1]
Pull pull_at(const Linkage& linkage, const Pull& pull, double share);

struct DeploymentOptions {
  double turn = 0.17;    ///< rad, > 0: how far the pull may turn a body in a step: ten degrees
  double shift = 0.25;   ///< cell edges, > 0: or move it
  double closed = 1e-9;  ///< cell edges and rad, > 0: misfit of a hinge up to which a state is closed
  double limit =
      2e-3;  ///< cell edges and rad, by which a hinge may be open where it cannot close: as in the physics run
  int iterations = 100;             ///< in a step, >= 1
  std::function<bool()> stop = {};  ///< asked between steps
};

/// How a structure of rigid bodies follows a pull.
struct Deployment {
  std::vector<State> states;   ///< closed ones, rest first, mm
  std::vector<double> shares;  ///< of the way, 0 to 1, of each
  double gap = 0;              ///< largest mismatch of hinge points met, cell edges
  double axis_gap = 0;         ///< and of hinge axes, rad
  bool reached = false;        ///< the whole way, closed
  double off_rms =
      0;  ///< of the last state from the pull, at points half a cell edge from bodies' centers, cell edges
  double off_max = 0;  ///< likewise the largest, cell edges
};

/// States from rest on along the pull, closed within the limit: each the one nearest to the pull at its share of the way, in the sum of
/// the squares of the pulled points' distances, under all hinges closed, found from the one before. By the method of
/// multipliers with Gauss-Newton steps on the closure equations, which holds where hinges repeat each other. Of a
/// structure with several motions that is one answer of many, and the one that springs at these points would give.
/// @pre one pose a body in `pull`, all finite
Deployment deploy(const Linkage& linkage, const Pull& pull, const DeploymentOptions& options = {});

/// Half the mean turn of the hinges of a state, whichever way, rad, >= 0: what stands for theta where bodies are pulled.
double mean_half_turn(const Linkage& linkage, const State& state);

}  // namespace kinetix::model
