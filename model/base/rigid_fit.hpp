#pragma once

#include <Eigen/Core>

namespace kinetix {

/// Returns the rigid motion, as a 4 x 4 matrix, that brings `from` nearest to `to` by least squares. Method:
/// S. Umeyama, Least-squares estimation of transformation parameters between two point patterns, IEEE PAMI
/// 13, 1991.
/// @param from, to one point per column, equally many, in one unit; the shift is in that unit. Callers check
///   that the points are finite: otherwise the result is arbitrary or NaN
Eigen::Matrix4d rigid_fit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace kinetix
