#include "model/base/rigid_fit.hpp"

#include <Eigen/Geometry>

namespace kinetix {

Eigen::Matrix4d rigid_fit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  return Eigen::umeyama(from, to, false);
}

}  // namespace kinetix
