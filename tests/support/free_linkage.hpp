#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/state.hpp"

namespace kinetix::testing {

/// A rigid body of a linkage, at the start of its motion. Lengths in the linkage's own unit of length, masses
/// in kg, times in s.
struct FreeLinkageBody {
  model::Pose pose;                                   ///< p: centre of mass; R: principal axes
  double mass = 1;                                    ///< > 0
  Eigen::Vector3d inertia = Eigen::Vector3d::Ones();  ///< about the principal axes, each > 0
  model::Twist motion;                                ///< v of the centre of mass
};

/// A hinge between two bodies, as it stands in the world at the start; lengths in the linkage's unit.
struct FreeLinkageHinge {
  int a = -1, b = -1;  ///< bodies; -1 = the ground
  Eigen::Vector3d point;
  Eigen::Vector3d axis;  ///< unit vector
};

/// Rigid bodies and hinges in any arrangement, with closed loops: the standard mechanisms with known answers.
struct FreeLinkage {
  std::vector<FreeLinkageBody> bodies;
  std::vector<FreeLinkageHinge> hinges;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< units of length / s^2

  /// @throws InvalidInput, naming body or hinge, for a mass, inertia or axis out of range (NaN included). Also throws
  /// for a hinge of missing bodies, of one body with itself or of none.
  void validate() const;
};

/// Largest distance of a hinge's point, and largest angle of its axis, between its two bodies.
struct FreeLinkageGap {
  double point = 0;  ///< in the linkage's unit of length
  double axis = 0;   ///< rad
};
FreeLinkageGap linkage_gap(const FreeLinkage& linkage, const std::vector<model::Pose>& poses);

/// Kinetic and potential energy, kg length^2 / s^2. @param motion of each body, v of its centre of mass
double linkage_energy(const FreeLinkage& linkage, const std::vector<model::Pose>& poses,
                      const std::vector<model::Twist>& motion);

/// A uniform rod between two points: its axis is the third principal one, its thickness a hundredth of its
/// length in moments of inertia (a body must have all three). @param mass kg
FreeLinkageBody rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double mass);

}  // namespace kinetix::testing
