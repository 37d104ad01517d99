#include "model/contact/swept_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace kinetix::model {
namespace {

constexpr double still = 1e-12;  // rad per rad: below it a screw's axis is undefined

}  // namespace

void SweptMotion::turn_about(const Eigen::Vector3d& point, const Eigen::Vector3d& spin) {
  omega_ = spin;
  v_ = point.cross(spin);
  most_omega_ = spin.norm();
  anchor_ = point;
  turns_ = 1;
  axis_ = spin.normalized();
}

void SweptMotion::screw(const Eigen::Vector3d& omega, const Eigen::Vector3d& v) {
  omega_ = omega;
  v_ = v;
  most_omega_ = omega.norm();
  turns_ = 1;
  if (!(most_omega_ > still)) return;
  anchor_ = omega.cross(v) / omega.squaredNorm();
  axis_ = omega / most_omega_;
}

void SweptMotion::pass(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, double rate,
                       const RateBounds& bounds) {
  anchor_change_ = change(point, 0);
  anchor_ = point;
  const double room = 1 - h_ * most_omega_;
  const double across =
      room > 0 ? std::min(most_omega_, (omega_.cross(axis).norm() + h_ * omega_change_) / room) : most_omega_;
  omega_change_ += bounds.change + bounds.rate * across;
  omega_ += rate * axis;
  v_ += rate * point.cross(axis);
  most_omega_ = omega_.norm() + h_ * omega_change_;
  ++turns_;
  axis_ = axis;
}

double SweptMotion::change(const Eigen::Vector3d& r, double reach) const {
  return anchor_change_ + (omega_change_ + most_omega_ * most_omega_) * ((r - anchor_).norm() + reach);
}

double SweptMotion::change_along(const Eigen::Vector3d& n, const Eigen::Vector3d& r, double reach) const {
  return change(r, reach) * (turns_ == 1 ? n.cross(axis_).norm() : 1);
}

double SweptMotion::way(const Eigen::Vector3d& r, double reach) const {
  return h_ * (speed(r).norm() + omega_.norm() * reach + h_ / 2 * change(r, reach));
}

}  // namespace kinetix::model
