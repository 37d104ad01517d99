#pragma once

#include <Eigen/Core>
#include <compare>

#include "model/hinge/elasticity.hpp"

namespace kinetix::sim {

/// Collision shapes of a linkage's bodies in place of walls: convex pieces of each body, by their corners.
struct ContactParts {
  std::vector<std::vector<std::vector<Eigen::Vector3d>>>
      of_body;  ///< corners relative to the body's rest position, mm
};

/// Distance at rest, cell edges. Pieces of a body within this distance of another body pass through that
/// body's pieces within this distance, during the whole motion. Examples are a rod in its bore, ends of walls
/// at a thin block, and faces in contact.
inline constexpr double touching_at_rest = 0.02;

/// Two pieces of different bodies that pass through each other for that reason.
struct TouchingPieces {
  int body = 0, piece = 0;            ///< piece as ContactParts::of_body counts those of its body
  int other = 0, piece_of_other = 0;  ///< piece of the other body, other > body
  auto operator<=>(const TouchingPieces&) const = default;
};

/// Settings of a simulation. Lengths are in cell edges: it works in units with a cell edge of 1.
struct PhysicsOptions {
  double step_s = 1.0 / 1000;    ///< time step, s, in (0, 0.1]; at most 10 million of them in the run
  double joint_stiffness = 1e4;  ///< of the joints, over the parts' masses, in (0, 1e12]. Gaps that can close
                                 ///< do so at any value. Above 1e4, structures that must strain (no exact
                                 ///< family) tear near flat
  double reach = 0.18;           ///< half distance of a hinge's two constraint points, in (0, 10]: 0.3 of the
                                 ///< wall height at its default size
  double part_inertia = 0.1;     ///< of every part about every axis, over mass and edge squared, in (0, 100].
  /// Random disturbance of the first motion of every part, relative to its spin: up to this in every
  /// direction. The result should not depend on it. In [0, 1]
  double disturbance = 0;
  unsigned disturbance_seed = 0;  ///< the same seed disturbs the same parts in the same way
  double drive_seconds = 1.0;     ///< simulated time in which the drive moves, s, in (0, 1000]
  double settle_seconds = 1.0;    ///< simulated time after the drive before giving up, s, in [0, 1000]
  double settle_damping = 50.0;   ///< decay rate of all speeds while settling, 1/s, in [0, 1e6]
  double settle_speed = 1e-8;     ///< settled when every hinge turns more slowly, rad/s, > 0
  /// Elastic hinges of the equilibrium model in place of rigid revolute joints; their reach replaces `reach`.
  /// Only ratios of stiffnesses affect the settled state. The scale is fixed: k_point is 1000 part masses /
  /// step_s^2, so the number of steps to settle does not depend on step_s. joint_stiffness, settle_damping,
  /// settle_speed and overlap_limit are not used then.
  /// Gaps are no failure: gap_limit applies to the drive, stretch_limit to the hinges, half a wall's
  /// thickness to overlaps. Each wall tip edge (end of a half wall) that presses on a wall yields by its
  /// force over elastic.contact. Plates and a driven hinge yield 1e4 times less than a hinge point. Those of
  /// the equilibrium model do not yield at all, a difference of about 1e-4 of the hinges' gaps.
  std::optional<model::Stiffness> elastic;
  double spring_turn = 0;      ///< shape memory: stiffness of each spring, in the unit of elastic->turn; >= 0
  double settle_force = 1e-7;  ///< elastic: settled when the net force on any part is at most this over the
                               ///< largest force in a hinge, > 0.
  /// Elastic: largest residual motion of a settled run, cell edges, or rad at half an edge. It is measured
  /// over the last 200 steps before the time is up, or all since the end of the drive if these are at least
  /// 100. A contact between two corners may jump from face to face forever. 0: never settled in this way. In
  /// [0, 0.1]
  double settle_residual_motion = 0;
  double stretch_limit = 0.5;   ///< elastic: failure: a larger hinge gap at any time; ends the run, > 0
  bool contact = true;          ///< half walls collide, except the two that share a hinge
  bool planar = false;          ///< parts slide and turn only in the plane z = 0, as a display on a table
  double gap_limit = 2e-3;      ///< failure: a larger final gap of a hinge or of the drive, > 0
  double tear_limit = 0.1;      ///< failure: a larger hinge gap at any time; ends the run, > 0
  double overlap_limit = 2e-3;  ///< failure: parts overlap by more at any time; ends the run, > 0
  double speed_limit = 1e4;     ///< failure: a faster part (edges/s or rad/s); ends the run, > 0

  /// @throws InvalidInput, naming the field, its value and its range (NaN is outside every range).
  void validate() const;
};

}  // namespace kinetix::sim
