#pragma once

#include <vector>

#include "model/contact/swept_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Points that move with one body over an interval of theta, in an observer's frame.
struct SweptPoints {
  const Eigen::Matrix3Xd* points = nullptr;  ///< relative to the body's rest position, mm
  Pose pose = {};                            ///< pose of the body in the middle of the interval
  const SweptMotion* motion = nullptr;       ///< motion of the body; null: at rest
  /// Center of a sphere around the points in the middle of the interval, mm
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;  ///< radius of that sphere, mm
};

/// A convex part: the hull of points of one body, or of two bodies for a block between them.
using SweptHull = std::vector<SweptPoints>;

/// Computes a lower bound of the gap of two parts along a unit direction n, over the whole interval, mm. The observer
/// carries n. A negative value proves no gap. With r' and r'' as in SweptMotion, and tau from -h to h,
///   gap(tau) >= min over b of (n . (r + tau r') - tau^2/2 |n . r''|) - max over a of (n . (r + tau r') + tau^2/2 |n . r''|),
/// which is concave in tau, so its minimum is at an end.
/// @param half_width h, rad; 0: only in the middle
double least_gap(const SweptHull& a, const SweptHull& b, const Eigen::Vector3d& n, double half_width);

/// Returns a bound of the displacement of any point of a part from the middle of the interval, mm.
double way(const SweptHull& part);

}  // namespace kinetix::model
