#pragma once

namespace kinetix {

/// Settings of a physics run. Lengths are in cell edges: the run works in units where the cell edge is 1.
struct PhysicsOptions {
  enum class Solver { direct, sweeps };

  Solver solver = Solver::direct;
  double step_s = 1.0 / 1000;     ///< time step, s, in (0, 0.1]
  int iterations = 200;           ///< sweeps of the solver over all constraints per step, 1 to 100000
  double error_reduction = 0.95;  ///< part of a hinge's gap removed per step, in (0, 1]
  double reach = 0.18;          ///< half distance of a hinge's two constraint points, in (0, 10]; 0.3 of the
                                ///< wall height for walls of the default size
  double part_inertia = 0.1;    ///< of every part about every axis, over mass times edge squared, in (0, 100]
  double drive_seconds = 1.0;   ///< simulated time in which the drive moves, s, in (0, 1000]
  double settle_seconds = 1.0;  ///< simulated time after the drive before giving up, s, in [0, 1000]
  double settle_damping = 50.0;  ///< rate at which all speeds die away while settling, 1/s, in [0, 1e6]
  double settle_gap = 1e-6;      ///< settled when the largest hinge gap is below this, > 0, and ...
  double settle_speed = 1e-4;    ///< ... the fastest part slower than this, edges/s and rad/s, > 0
  bool contact = true;           ///< parts that do not share a hinge collide
  double gap_limit = 2e-3;       ///< a final hinge gap above this is a failure, > 0
  double speed_limit = 1e4;      ///< a part faster than this (edges/s or rad/s) has blown up, > 0

  /// @throws InvalidInput, naming the field, its value and its range (NaN is outside every range).
  void validate() const;
};

}  // namespace kinetix
