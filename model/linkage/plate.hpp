#pragma once

#include <Eigen/Core>

namespace kinetix::model {

/// Part of a wall that belongs to one body, as a plate from the body's vertex to the wall's tip at the hinge.
/// It is tilted with the wall about its neutral axis. The frame is the body's rest frame, lengths are in cell
/// edges.
struct Plate {
  int body = 0;
  int hinge = 0;
  Eigen::Vector3d edge;     ///< unit, from the vertex to the tip
  Eigen::Vector3d up;       ///< unit, along the plate's height
  Eigen::Vector3d up_beta;  ///< derivative of `up` by the hinge's beta
  double length = 0;        ///< from the vertex to the tip
  double length_t = 1;      ///< derivative of `length` by the hinge's t
  /// Extra length of the tip cut along the hinge axis, ratio to the height: cot(alpha), signed
  double slant = 0;
};

}  // namespace kinetix::model
