#include "model/linkage/linkage_drive.hpp"

#include <cmath>

namespace kinetix::model {

double LinkageDrive::theta() const {
  if (kind == Kind::plates) return branch * 2 * std::asin(std::sqrt(compression / 2));
  return theta_at_turn(sense, angle);
}

}  // namespace kinetix::model
