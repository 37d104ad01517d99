#pragma once

#include <Eigen/Core>
#include <array>

#include "model/linkage/hinge_parameters.hpp"
#include "model/linkage/plate.hpp"
#include "model/linkage/rest_hinge.hpp"

namespace kinetix::model {

/// A wall between the vertices of two bodies, flat at rest, and the hinge that divides it.
struct HingedWall {
  int lower = 0, upper = 0;  ///< bodies
  Eigen::Vector3d edge;  ///< from the lower body's vertex to the upper one's, in the plane z = 0, cell edges
  HingeParameters hinge;
};

/// Returns the up-direction w(beta) = cos(beta) z + sin(beta) (e x z) of a wall plate at rest, unit length.
/// @param edge in the plane z = 0, of any length but 0   @param beta rad
Eigen::Vector3d wall_up(const Eigen::Vector3d& edge, double beta);

/// Returns the hinge axis d = cos(alpha) e + sin(alpha) w(beta) at rest, unit length. @param edge as for
/// wall_up
Eigen::Vector3d hinge_axis(const Eigen::Vector3d& edge, const HingeParameters& parameters);

RestHinge rest_hinge(const HingedWall& wall);

/// Returns the lower body's plate, then the upper body's. @param index of the hinge in its linkage
std::array<Plate, 2> plates(const HingedWall& wall, int index);

}  // namespace kinetix::model
