#pragma once

#include <Eigen/Core>

#include "model/base/angle.hpp"

namespace kinetix::model {

/// Four design parameters of the hinge on a wall along the edge e, from its lower body's vertex to its upper
/// body's vertex. The defaults are the basic planar hinge.
struct HingeParameters {
  double t = 0.5;         ///< fraction of the wall from the lower body's vertex, in (0, 1)
  double alpha = pi / 2;  ///< in-plane angle of the hinge axis from e, rad, in (0, pi)
  double beta = 0;        ///< out-of-plane tilt of the wall, rad, in (-pi/2, pi/2)
  double offset = 0;      ///< of the hinge point across the wall, in the direction z x e, cell edges
};

/// Derivatives by t (fraction), alpha (rad), beta (rad) and offset (cell edges) of one hinge.
using DesignGradient = Eigen::Vector4d;

}  // namespace kinetix::model
