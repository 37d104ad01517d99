#pragma once

#include "model/contact/linkage_motion.hpp"
#include "model/contact/swept_motion.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// How far a state is from what hinges and their laws say.
struct LawDeviation {
  double gap = 0;  ///< largest between the two points of a hinge, cell edges
  double off = 0;  ///< largest of its axes and turns, rad
  int hinge = -1;  ///< that turns otherwise, not within rounding; -1: none
};

/// An interval of theta to one side of flat: the state in its middle, and what bounds it all over.
class ThetaInterval {
 public:
  /// @param linkage kept by reference   @param sign of theta, 1 or -1   @param low, high without sign, rad
  ThetaInterval(const LinkageMotion& linkage, const ExactMotion& exact, double sign, double low, double high);

  double theta() const { return theta_; }            ///< of the middle, rad
  double half_width() const { return half_width_; }  ///< rad, rounded up
  const State& state() const { return state_; }

  /// A body as another one sees it in the middle.
  Pose relative(int from, int body) const;
  /// Its motion over the interval, likewise. @param chain from the one to the other
  SweptMotion motion(int from, const HingeChain& chain) const;
  /// Of all bodies, while the middle body turns about its first axis.
  std::vector<SweptMotion> motions() const;
  /// In the middle.
  LawDeviation deviation() const;

 private:
  void pass(const ChainStep& step, const Pose& frame, SweptMotion& motion) const;

  const LinkageMotion& linkage_;
  double half_width_, theta_;
  State state_;
  std::vector<double> rates_;       ///< of each law in the middle, rad per rad
  std::vector<RateBounds> bounds_;  ///< of each law over the interval
};

}  // namespace kinetix::model
