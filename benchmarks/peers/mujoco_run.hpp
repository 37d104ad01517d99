#pragma once

#include <string>

#include "model/lattice/lattice_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::bench {

/// Settings of a MuJoCo run. The cell edge is 1, as in PhysicsOptions, whose masses and course it shares.
struct MujocoSettings {
  /// Form of the scene in MuJoCo.
  enum class Bodies {
    free,  ///< every vertex floats; two `connect` equalities per hinge, at +- reach on its axis
    tree   ///< hinge joints along a tree of fewest walls from the driven hinge; the other hinges as above
  };
  enum class Integrator { euler, implicit };
  enum class Solver { newton, cg };

  Bodies bodies = Bodies::tree;
  Integrator integrator = Integrator::euler;
  Solver solver = Solver::newton;
  double step_s = 1.0 / 240;      ///< s, > 0
  int iterations = 2;             ///< of the constraint solver in a step, at most
  double tolerance = 0;           ///< of the constraint solver, at which it may stop before
  double impedance = 0.9999;      ///< of the equalities (solimp), MuJoCo's largest
  double error_reduction = 0.95;  ///< part of a gap removed per step: solref = (-this / step^2, -1 / step)
  double reach = 0.18;            ///< half distance of a hinge's two points, cell edges
  double part_inertia = 0.1;      ///< over mass and edge squared
  double drive_seconds = 1.0;     ///< simulated time in which the drive moves, s
  double settle_seconds = 1.0;    ///< simulated time after the drive before giving up, s
  double settle_damping = 50.0;   ///< rate at which all speeds die away while settling, 1/s
  double settle_speed = 1e-8;     ///< settled when every hinge turns more slowly, rad/s
};

/// Outcome of a MuJoCo run.
struct MujocoResult {
  enum class Status { settled, not_settled, blew_up, not_installed };

  Status status = Status::not_installed;
  model::State state;  ///< last state, mm, in the structure's body order; empty where MuJoCo is not installed
  model::HingeGaps gaps;  ///< of that state
  double drive_gap = 0;   ///< of the driven hinge from its angle, rad
  int steps = 0;          ///< taken
  double seconds = 0;     ///< wall-clock time of the steps; as in PhysicsResult, setting up is not counted
};

std::string to_string(MujocoResult::Status status);
bool has_mujoco();

/// Makes the run of sim/physics_run.hpp in MuJoCo. It starts flat, along the first-order motion of
/// sim/physics_run.hpp. Theta moves to its goal along tau (2 - tau); then the motion is damped until nothing turns.
/// There is no contact and no gravity.
/// @throws InvalidInput for a drive that is not a driven hinge of the structure; std::runtime_error for a scene that
/// MuJoCo refuses
MujocoResult run_mujoco(const model::Structure& structure, const model::LinkageDrive& drive,
                        const MujocoSettings& settings = {});

}  // namespace kinetix::bench
