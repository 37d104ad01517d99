#include "model/base/geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kinetix {
namespace {

constexpr double opposite = 1e-12;  // 1 + cosine: below it, rounding decides the axis

/// (1 - cos a) / a^2, by its series for small a.
double second(double a) { return a < 1e-4 ? 0.5 - a * a / 24 : (1 - std::cos(a)) / (a * a); }
/// (a - sin a) / a^3, by its series for small a.
double third(double a) { return a < 1e-2 ? 1.0 / 6 - a * a / 120 : (a - std::sin(a)) / (a * a * a); }

}  // namespace

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  // Eigen's function for this compiles a singular value decomposition, which takes seconds.
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double whole = 1 + a.dot(b);
  if (!(whole > opposite)) return Eigen::AngleAxisd(pi, a.unitOrthogonal()).toRotationMatrix();
  const double twice_cosine = std::sqrt(2 * whole);  // of half the angle
  Eigen::Quaterniond turn(twice_cosine / 2, 0, 0, 0);
  turn.vec() = a.cross(b) / twice_cosine;
  return turn.toRotationMatrix();
}

Eigen::Matrix3d rotation_rate(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  const Eigen::Matrix3d m = cross_matrix(v);
  return Eigen::Matrix3d::Identity() + second(angle) * m + third(angle) * m * m;
}

Eigen::Matrix4d rigid_fit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  return Eigen::umeyama(from, to, false);
}

}  // namespace kinetix
