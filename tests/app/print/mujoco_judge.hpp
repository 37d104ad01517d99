#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace kinetix::testing {

/// The simulation by MuJoCo of a scene whose actuator moves slowly from 0 to 1.
struct MujocoVerdict {
  std::string error;  ///< load error or warnings; empty: none
  double mass_kg = 0;
  int joints = 0, constraints = 0;
  double energy_J = 0;                     ///< energy of the springs at the end
  std::vector<Eigen::Vector3d> positions;  ///< positions of the bodies b0, b1, ... at the end, m
};

/// Simulates a scene in MuJoCo.
/// @param fold_seconds simulated time of the actuator's motion
MujocoVerdict fold_in_mujoco(const std::string& xml, double fold_seconds, double settle_seconds);

}  // namespace kinetix::testing
