#pragma once

#include <vector>

#include "model/contact/swept_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Points that go with one body over an interval of theta, as an observer sees them.
struct SweptPoints {
  const Eigen::Matrix3Xd* points = nullptr;  ///< relative to the body's rest position, mm
  Pose pose = {};                            ///< of the body in the middle of the interval
  const SweptMotion* motion = nullptr;       ///< of the body; null: at rest
  Eigen::Vector3d center =
      Eigen::Vector3d::Zero();  ///< of a sphere round the points, where they are in the middle, mm
  double radius = 0;            ///< of that sphere, mm
};

/// A convex part: the hull of points of one body, or of two, as a block between them.
using SweptHull = std::vector<SweptPoints>;

/// A bound of the gap of two parts along a unit direction n that the observer carries, over the whole interval, mm; negative:
/// none is proven. With r' and r'' as in SweptMotion, and tau from -h to h,
///   gap(tau) >= min over b of (n . (r + tau r') - tau^2/2 |n . r''|) - max over a of (n . (r + tau r') + tau^2/2 |n . r''|),
/// which is concave in tau and so least at an end.
/// @param half_width h, rad; 0: in the middle alone
double least_gap(const SweptHull& a, const SweptHull& b, const Eigen::Vector3d& n, double half_width);

/// How far any point of a part gets from where it is in the middle, mm.
double way(const SweptHull& part);

}  // namespace kinetix::model
