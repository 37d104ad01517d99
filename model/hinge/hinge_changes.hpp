#pragma once

#include <Eigen/Geometry>

#include "model/hinge/frame_energy.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Changes of a hinge's mismatches and frame: along twists of its two bodies, by changes of the vectors that
/// they carry, and by both.
class HingeChanges {
 public:
  HingeChanges(const Pose& lower, const Pose& upper, const Vector12& along)
      : lower_(lower.R),
        upper_(upper.R),
        lower_turn_(along.segment<3>(0)),
        upper_turn_(along.segment<3>(6)),
        shift_(along.segment<3>(3) - along.segment<3>(9)) {}

  DirectedChange along(const Mismatch& m, const Eigen::Vector3d& w0, bool shifts) const {
    Eigen::Vector3d gap = lower_turn_.cross(m.lower) - upper_turn_.cross(m.upper);
    if (shifts) gap += shift_;
    return {gap, lower_turn_.cross(lower_ * w0) + upper_turn_.cross(upper_ * w0)};
  }
  /// @param rest change of the vector whose mismatch is taken   @param w change of w0
  DirectedChange by(const Eigen::Vector3d& rest, const Eigen::Vector3d& w) const {
    return {lower_ * rest - upper_ * rest, lower_ * w + upper_ * w};
  }
  DirectedChange both(const Eigen::Vector3d& rest, const Eigen::Vector3d& w) const {
    return {lower_turn_.cross(lower_ * rest) - upper_turn_.cross(upper_ * rest),
            lower_turn_.cross(lower_ * w) + upper_turn_.cross(upper_ * w)};
  }

 private:
  const Eigen::Matrix3d &lower_, &upper_;
  const Eigen::Vector3d lower_turn_, upper_turn_, shift_;
};

}  // namespace kinetix::model
