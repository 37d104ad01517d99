#pragma once

#include <Eigen/Geometry>

#include "model/linkage/state.hpp"

namespace kinetix::python {

/// Numbers of a pose in a table: x y z in mm, then the quaternion w x y z, as result.json has them.
inline constexpr int pose_numbers = 7;

/// Writes a state as rows of seven numbers. @param rows has room for 7 numbers per body
inline void write_poses(const model::State& state, double* rows) {
  for (const model::Pose& pose : state) {
    const Eigen::Quaterniond q(pose.R);
    for (const double number : {pose.p.x(), pose.p.y(), pose.p.z(), q.w(), q.x(), q.y(), q.z()})
      *rows++ = number;
  }
}

}  // namespace kinetix::python
