#pragma once

#include <optional>

#include "model/hinge/elasticity.hpp"

namespace kinetix::sim {

/// Settings of a physics run. Lengths are in cell edges: the run works in units where the cell edge is 1.
struct PhysicsOptions {
  double step_s = 1.0 / 1000;    ///< time step, s, in (0, 0.1]; at most 10 million of them in the run
  double joint_stiffness = 1e4;  ///< of the joints, over the parts' masses, in (0, 1e12]. Gaps that
                                 ///< can close do close whatever it is; above 1e4, structures that must
                                 ///< strain (no exact family) tear near flat
  double reach = 0.18;           ///< half distance of a hinge's two constraint points, in (0, 10]: 0.3 of the
                                 ///< wall height at its default size
  double part_inertia = 0.1;     ///< of every part about every axis, over mass and edge squared, in (0, 100]
  /// How far the first motion of every part is thrown off at random, over its own spin: up to this in every
  /// direction. What comes out should not depend on it. In [0, 1]
  double disturbance = 0;
  unsigned disturbance_seed = 0;  ///< the same seed throws the same parts the same way
  double drive_seconds = 1.0;     ///< simulated time in which the drive moves, s, in (0, 1000]
  double settle_seconds = 1.0;    ///< simulated time after the drive before giving up, s, in [0, 1000]
  double settle_damping = 50.0;   ///< rate at which all speeds die away while settling, 1/s, in [0, 1e6]
  double settle_speed = 1e-8;     ///< settled when every hinge turns more slowly, rad/s, > 0
  /// Elastic hinges instead of rigid rotary ones, as the equilibrium model has them; their reach replaces
  /// `reach`. Only ratios of stiffnesses matter for where the run settles. The scale
  /// is the run's: k_point is 1000 part masses / step_s^2, whence it settles in as many steps whatever step_s
  /// is. joint_stiffness, settle_damping, settle_speed and overlap_limit are not used then.
  /// Gaps are no failure: gap_limit holds for the drive, stretch_limit for the hinges, half a wall's
  /// thickness for overlaps. Each wall tip edge (end of a half wall) that presses on a wall yields by its
  /// force over elastic.contact. Plates and a driven hinge yield 1e4 times less than a hinge point does,
  /// where the equilibrium model's do not yield at all: a difference of about 1e-4 of the hinges' gaps.
  std::optional<model::Stiffness> elastic;
  double spring_turn = 0;      ///< shape memory: stiffness of each spring, in the unit of elastic->turn; >= 0
  double settle_force = 1e-7;  ///< elastic: settled when no part is pushed by more than this over the largest
                               ///< force in a hinge, > 0
  /// Elastic: settled, too, when in the last 200 steps before the time is up, or all since the end of the drive where these are
  /// 100 at least, no part moved by more than this (cell edges, or rad at half an edge): where a corner rests on a corner, the contact may jump from one
  /// face to the other for ever. 0: never. In [0, 0.1]
  double settle_residual_motion = 0;
  double stretch_limit = 0.5;   ///< elastic: failure: a larger hinge gap at any time; ends the run, > 0
  bool contact = true;          ///< half walls collide, except the two that share a hinge
  bool planar = false;          ///< parts slide and turn in the plane z = 0 only, as a display on a table
  double gap_limit = 2e-3;      ///< failure: a larger final gap of a hinge or of the drive, > 0
  double tear_limit = 0.1;      ///< failure: a larger hinge gap at any time; ends the run, > 0
  double overlap_limit = 2e-3;  ///< failure: parts overlap by more at any time; ends the run, > 0
  double speed_limit = 1e4;     ///< failure: a faster part (edges/s or rad/s); ends the run, > 0

  /// @throws InvalidInput, naming the field, its value and its range (NaN is outside every range).
  void validate() const;
};

}  // namespace kinetix::sim
