#pragma once

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// Pose of a body: a point r of its rest frame (mm) is carried to p + R (r - rest position).
template <class T>
struct PoseOf {
  Eigen::Matrix<T, 3, 3> R = Eigen::Matrix<T, 3, 3>::Identity();
  Eigen::Matrix<T, 3, 1> p = Eigen::Matrix<T, 3, 1>::Zero();

  bool operator==(const PoseOf&) const = default;
};
using Pose = PoseOf<double>;

/// One pose per body of a structure, in its body order; positions in mm.
using State = std::vector<Pose>;

/// Rate of change of a pose: dR = [omega]x R, dp = v. The function that returns one documents the parameter
/// and the length unit, mm or cell edges.
struct Twist {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();  ///< rad
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
};

/// Returns the flat state, mm.
State rest_state(const Linkage& structure);

bool is_finite(const State& state);

/// Joint separations: differences between the two bodies of each hinge.
struct HingeGaps {
  double max = 0;  ///< distance of the carried hinge points, in cell edges
  double rms = 0;  ///< distance of the carried hinge points, in cell edges, root mean square over all hinges
  double axis_max = 0;   ///< angle of the carried hinge axes, rad
  int worst_hinge = -1;  ///< index of the hinge with the largest distance
  int worst_axis = -1;   ///< index of the hinge with the largest angle
};

/// Computes the joint separations. NaN anywhere in the state gives NaN in max and rms. @pre state.size() ==
/// structure.bodies.size()
HingeGaps hinge_gaps(const Linkage& structure, const State& state);

/// Distance of two states after the best rigid motion of `state` onto `reference`.
struct StateDistance {
  double rms = 0;  ///< root mean square over the body positions, in cell edges
  double max = 0;  ///< largest over the body positions, in cell edges
};

/// Returns the distance after proper rigid alignment (Umeyama without scaling). NaN in either state gives
/// NaN.
StateDistance aligned_distance(const Linkage& structure, const State& state, const State& reference);

/// Returns the best rigid motion of `state` onto `reference`, x -> R x + p, mm. @pre both are finite
Pose motion_onto(const State& state, const State& reference);
/// Returns the state with all bodies moved by one rigid motion.
State moved(State state, const Pose& motion);
/// Returns `state` after its best rigid motion onto `reference`. @pre both are finite
State aligned(const State& state, const State& reference);

/// Two vectors that are equal at rest, carried by the two bodies of a hinge, and their difference. Lengths
/// are in cell edges for point_mismatch() and dimensionless for axis_mismatch().
struct Mismatch {
  Eigen::Vector3d gap;           ///< lower body's vector minus the upper body's
  Eigen::Vector3d lower, upper;  ///< turned with the bodies: arms to the hinge point, or the hinge axis
};

/// Computes the mismatch of the hinge point, cell edges.
inline Mismatch point_mismatch(const RestHinge& h, const Pose& lower, const Pose& upper, double edge_mm) {
  Mismatch m;
  m.lower = lower.R * h.lower_arm;
  m.upper = upper.R * h.upper_arm;
  m.gap = (lower.p - upper.p) / edge_mm + m.lower - m.upper;
  return m;
}

/// Computes the mismatch of the unit hinge axis, dimensionless; small values are nearly rad. A ball joint has
/// no axis and gives zero.
inline Mismatch axis_mismatch(const RestHinge& h, const Pose& lower, const Pose& upper) {
  Mismatch m;
  if (h.ball) return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  m.lower = lower.R * h.axis;
  m.upper = upper.R * h.axis;
  m.gap = m.lower - m.upper;
  return m;
}

}  // namespace kinetix::model
