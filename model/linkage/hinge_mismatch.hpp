#pragma once

#include "model/linkage/rest_hinge.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

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
