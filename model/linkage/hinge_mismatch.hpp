#pragma once

#include "model/linkage/rest_hinge.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Two vectors of one length at rest, as the two bodies of a hinge carry them, and how far they are apart. In
/// cell edges, or of unit axes: see point_mismatch() and axis_mismatch().
struct Mismatch {
  Eigen::Vector3d gap;           ///< of the lower body's less the upper one's
  Eigen::Vector3d lower, upper;  ///< turned with the bodies: arms to the hinge point, or the hinge axis
};

/// Of the hinge point, cell edges.
inline Mismatch point_mismatch(const RestHinge& h, const Pose& lower, const Pose& upper, double edge_mm) {
  Mismatch m;
  m.lower = lower.R * h.lower_arm;
  m.upper = upper.R * h.upper_arm;
  m.gap = (lower.p - upper.p) / edge_mm + m.lower - m.upper;
  return m;
}

/// Of the unit hinge axis, dimensionless: nearly rad where small. All zero of a ball, which has none.
inline Mismatch axis_mismatch(const RestHinge& h, const Pose& lower, const Pose& upper) {
  Mismatch m;
  if (h.ball) return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  m.lower = lower.R * h.axis;
  m.upper = upper.R * h.axis;
  m.gap = m.lower - m.upper;
  return m;
}

}  // namespace kinetix::model
