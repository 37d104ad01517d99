#pragma once

#include <Eigen/Core>

namespace kinetix::model {

/// The part of a wall that belongs to one body, in that body's rest frame, lengths in cell edges: a plate
/// from the body's vertex to the wall's tip at the hinge, tilted with the wall about its neutral axis.
struct Plate {
  int body = 0;
  int hinge = 0;
  Eigen::Vector3d edge;     ///< unit, from the vertex to the tip
  Eigen::Vector3d up;       ///< unit, along the plate's height
  Eigen::Vector3d up_beta;  ///< its derivative by the hinge's beta
  double length = 0;        ///< from the vertex to the tip
  double length_t = 1;      ///< its derivative by the hinge's t
  double slant =
      0;  ///< by which the tip cut along the hinge axis is longer, ratio to the height: cot(alpha) with sign
};

}  // namespace kinetix::model
