#include "model/linkage/linkage_drive.hpp"

#include <cmath>

namespace kinetix::model {

double LinkageDrive::theta() const {
  if (kind == Kind::plates) return branch * 2 * std::asin(std::sqrt(compression / 2));
  if (kind == Kind::cord) return branch * 2 * std::asin(std::sqrt(shorten_mm / rest_mm / 2));
  if (kind == Kind::shape_memory) return angle / 2;
  if (kind == Kind::none) return 0;
  return theta_at_turn(sense, angle);
}

LinkageDrive LinkageDrive::to(double theta) const {
  LinkageDrive out = *this;
  const double closer = 2 * std::pow(std::sin(theta / 2), 2);  // 1 - cos(theta) without its rounding
  out.branch = theta < 0 ? -1 : 1;
  if (kind == Kind::plates) out.compression = closer;
  if (kind == Kind::cord) out.shorten_mm = closer * rest_mm;
  if (kind == Kind::shape_memory) out.angle = 2 * theta;
  if (kind == Kind::hinge) out.angle = turn_at_theta(sense, theta);
  return out;
}

std::string LinkageDrive::coordinate_unit() const {
  if (kind == Kind::plates) return "compression";
  return kind == Kind::cord ? "mm" : "rad";
}

}  // namespace kinetix::model
