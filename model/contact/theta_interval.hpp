#pragma once

#include "model/contact/linkage_motion.hpp"
#include "model/contact/swept_motion.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Deviation of a state from its hinges and their laws.
struct LawDeviation {
  double gap = 0;  ///< largest joint separation, cell edges
  double off = 0;  ///< largest misfit of axes and turns, rad
  int hinge = -1;  ///< hinge that deviates from its law by more than rounding; -1: none
};

/// An interval of theta to one side of flat: the state in its middle, and bounds over the interval.
class ThetaInterval {
 public:
  /// @param linkage kept by reference   @param sign of theta, 1 or -1   @param low, high without sign, rad
  ThetaInterval(const LinkageMotion& linkage, const ExactMotion& exact, double sign, double low, double high);

  double theta() const { return theta_; }            ///< theta in the middle, rad
  double half_width() const { return half_width_; }  ///< rad, rounded up
  const State& state() const { return state_; }

  /// Returns the pose of a body in another body's frame, in the middle.
  Pose relative(int from, int body) const;
  /// Returns the motion of a body over the interval in another body's frame. @param chain from the other body to it
  SweptMotion motion(int from, const HingeChain& chain) const;
  /// Returns the motions of all bodies, while the middle body turns about its first axis.
  std::vector<SweptMotion> motions() const;
  /// Returns the deviation of the state in the middle.
  LawDeviation deviation() const;

 private:
  void pass(const ChainStep& step, const Pose& frame, SweptMotion& motion) const;

  const LinkageMotion& linkage_;
  double half_width_, theta_;
  State state_;
  std::vector<double> rates_;       ///< rate of each law in the middle, rad per rad
  std::vector<RateBounds> bounds_;  ///< bounds of each law over the interval
};

}  // namespace kinetix::model
