#include "model/linkage/linkage.hpp"

#include <algorithm>

namespace kinetix::model {
namespace {

constexpr double vertical = 1e-9;  // rad from z: far above rounding, far below any tilt that is meant

}  // namespace

bool is_vertical(const Eigen::Vector3d& axis) { return axis.head<2>().norm() <= vertical; }

bool is_vertical(const RestHinge& hinge) { return !hinge.ball && is_vertical(hinge.axis); }

Eigen::Vector3d Linkage::rest_position(int body) const { return bodies[body].position * size.edge_mm; }

bool all_vertical(const Linkage& linkage) {
  return std::all_of(linkage.hinges.begin(), linkage.hinges.end(),
                     [](const RestHinge& hinge) { return is_vertical(hinge); });
}

}  // namespace kinetix::model
