#include "model/contact/swept_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace kinetix::model {

void SweptMotion::turn_about(const Eigen::Vector3d& point, const Eigen::Vector3d& spin) {
  omega_ = spin;
  v_ = point.cross(spin);
  most_omega_ = spin.norm();
  anchor_ = point;
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
}

double SweptMotion::change(const Eigen::Vector3d& r, double reach) const {
  return anchor_change_ + (omega_change_ + most_omega_ * most_omega_) * ((r - anchor_).norm() + reach);
}

double SweptMotion::way(const Eigen::Vector3d& r, double reach) const {
  return h_ * (speed(r).norm() + omega_.norm() * reach + h_ / 2 * change(r, reach));
}

}  // namespace kinetix::model
