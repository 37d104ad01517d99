#pragma once

#include "model/hinge/element.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Turn of a hinge's upper body against its lower one about the hinge axis (rad, from -pi to pi). It is the
/// twist part of the relative rotation, computed from its unit quaternion. Derivatives are by a turn of the
/// upper body in the upper body's frame, rad.
class RelativeTurn {
 public:
  RelativeTurn(const RestHinge& hinge, const Pose& lower, const Pose& upper);

  double angle() const;
  Eigen::Vector3d rate() const;
  Eigen::Matrix3d second() const;
  /// Change of angle() and of rate() if the axis changes by `axis_rate`.
  double angle_change(const Eigen::Vector3d& axis_rate) const;
  Eigen::Vector3d rate_change(const Eigen::Vector3d& axis_rate) const;
  /// Returns rate() in the global frame.
  Eigen::Vector3d rate_in_space() const { return upper_ * rate(); }
  /// Returns angle() with its derivatives by the twists of both bodies.
  Element element() const;

 private:
  double squared() const { return w_ * w_ + s_ * s_; }

  double w_, s_;  ///< of the quaternion: scalar part, and vector part along the axis
  Eigen::Vector3d v_, w_rate_, s_rate_;
  Eigen::Matrix3d upper_;
};

/// Derivatives of that turn (rad), and of its change along given twists, by the hinge's parameters. Only
/// alpha and beta have an effect.
struct TurnGradients {
  DesignGradient turn = DesignGradient::Zero();
  DesignGradient along = DesignGradient::Zero();
};

/// @param against turn of the upper body against the lower one, in the upper body's frame, rad
TurnGradients turn_gradients(const RestHinge& hinge, const RelativeTurn& turn,
                             const Eigen::Vector3d& against);
/// @param along twists of the two bodies (rad, cell edges), ordered as in Element
TurnGradients turn_gradients(const RestHinge& hinge, const Pose& lower, const Pose& upper,
                             const Vector12& along);

}  // namespace kinetix::model
