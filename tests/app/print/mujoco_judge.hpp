#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace kinetix::testing {

/// What MuJoCo makes of a scene whose actuator goes slowly from 0 to 1.
struct MujocoVerdict {
  std::string error;  ///< why it does not load, or what it warned of; empty: nothing
  double mass_kg = 0;
  int joints = 0, constraints = 0;
  double energy_J = 0;                     ///< of its springs at the end
  std::vector<Eigen::Vector3d> positions;  ///< of the bodies b0, b1, ... at the end, m
};

/// @param fold_seconds in which the actuator moves, simulated
MujocoVerdict fold_in_mujoco(const std::string& xml, double fold_seconds, double settle_seconds);

}  // namespace kinetix::testing
