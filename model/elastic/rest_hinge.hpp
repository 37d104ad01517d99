#pragma once

#include <Eigen/Core>

#include "model/structure.hpp"

namespace kinetix {

/// A hinge in the rest frames of its two bodies, lengths in cell edges.
struct RestHinge {
  int lower = 0, upper = 0;
  Eigen::Vector3d edge;       ///< unit edge vector
  Eigen::Vector3d lower_arm;  ///< from the lower body's vertex to the hinge point
  Eigen::Vector3d upper_arm;
  Eigen::Vector3d axis;        ///< unit
  Eigen::Vector3d axis_alpha;  ///< its derivative by alpha
  Eigen::Vector3d axis_beta;   ///< and by beta
};

RestHinge rest_hinge(const Hinge& hinge);

}  // namespace kinetix
