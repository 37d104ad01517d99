#include "model/linkage/linkage_drive.hpp"

#include <cmath>

namespace kinetix::model {

double LinkageDrive::theta() const {
  if (kind == Kind::plates) return branch * 2 * std::asin(std::sqrt(compression / 2));
  if (kind == Kind::cord) return branch * 2 * std::asin(std::sqrt(shorten_mm / rest_mm / 2));
  if (kind == Kind::shape_memory) return angle / 2;
  return theta_at_turn(sense, angle);
}

std::string LinkageDrive::coordinate_unit() const {
  if (kind == Kind::plates) return "compression";
  return kind == Kind::cord ? "mm" : "rad";
}

}  // namespace kinetix::model
