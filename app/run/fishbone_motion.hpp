#pragma once

#include <functional>

#include "optim/ribs/fit_layout.hpp"

namespace kinetix::app {

/// States of a fishbone by theta, rad, in the frame of its search.
inline std::function<model::State(double theta)> motion_of(const optim::RibsDesign& design) {
  return [fishbone = design.fishbone, shape = design.shape](double theta) {
    return placed_fishbone(fishbone, shape, theta);
  };
}

/// The rigid motion to another frame.
inline model::Pose pose_of(const Eigen::Isometry3d& to) { return {to.linear(), to.translation()}; }

}  // namespace kinetix::app
