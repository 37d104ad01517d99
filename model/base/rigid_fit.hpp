#pragma once

#include <Eigen/Core>

namespace kinetix {

/// The rotation and shift, as one matrix, that bring points nearest to others by least squares (S. Umeyama, Least-squares
/// estimation of transformation parameters between two point patterns, IEEE PAMI 13, 1991).
/// @param from, to one point a column, of one unit; as many of each. The shift has their unit. A point that is not finite
///   makes the motion NaN or any: callers look first
Eigen::Matrix4d rigid_fit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace kinetix
