#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <numbers>

namespace kinetix {

inline constexpr double pi = std::numbers::pi;  ///< rad, half a turn
/// Radians per degree. Files and messages use degrees.
inline constexpr double radians_per_degree = pi / 180.0;
/// Converts an angle from rad to degrees, for messages: code works in radians.
constexpr double to_degrees(double radians) { return radians / radians_per_degree; }

/// Returns [v]x, the matrix that maps w to v x w.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}
/// Returns the rotation matrix of |v| rad about v.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& v);
/// Returns the smallest rotation that turns one direction into another. The vectors may have any length but
/// 0.
Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
/// Returns J with omega = J dv for the change d(rotation_of(v)) = [omega]x rotation_of(v): the left Jacobian
/// of SO(3). v in rad.
Eigen::Matrix3d rotation_rate(const Eigen::Vector3d& v);

/// Returns the rigid motion, as a 4 x 4 matrix, that brings `from` nearest to `to` by least squares. Method:
/// S. Umeyama, Least-squares estimation of transformation parameters between two point patterns, IEEE PAMI
/// 13, 1991.
/// @param from, to one point per column, equally many, in one unit; the shift is in that unit. Callers check
///   that the points are finite: otherwise the result is arbitrary or NaN
Eigen::Matrix4d rigid_fit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

/// Returns the signed area of a closed polygon, in squared units of its corners. Counter-clockwise is
/// positive.
/// @param count number of corners
/// @param corner function that returns corner k as an Eigen::Vector2d; k from 0
template <class Corner>
double signed_area(std::size_t count, const Corner& corner) {
  double twice = 0;
  for (std::size_t k = 0, before = count - 1; k < count; before = k++) {
    const Eigen::Vector2d a = corner(before), b = corner(k);
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/// Returns the signed area of a closed polygon that is given as a list of corners.
template <class Points>
double signed_area(const Points& points) {
  return signed_area(points.size(), [&](std::size_t k) -> const Eigen::Vector2d& { return points[k]; });
}

}  // namespace kinetix

namespace kinetix::model {

/// Returns the area of the parallelogram of two vectors, positive if b is left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

inline Eigen::Vector2d turned_by_90(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// Returns the distance from p to the nearest point of the wall from a to b. @pre a and b differ
inline double distance_to_wall(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double part = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - part * along).norm();
}

}  // namespace kinetix::model
