#pragma once

#include <Eigen/Geometry>

namespace kinetix::model {

/// Computes the axis-aligned bounding box of points, a list of Eigen::Vector2d or Vector3d.
template <class Points>
auto box_of(const Points& points) {
  Eigen::AlignedBox<double, Points::value_type::RowsAtCompileTime> box;
  for (const auto& p : points) box.extend(p);
  return box;
}

}  // namespace kinetix::model
