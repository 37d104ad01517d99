#pragma once

#include <Eigen/Core>

namespace kinetix::model {

/// A direction of the flat sheet.
enum class Axis { x, y };

/// Returns the unit vector of an axis.
inline Eigen::Vector3d edge_direction(Axis axis) {
  return axis == Axis::x ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
}

/// Returns the index of a vector's component along the axis: 0 or 1.
inline int component(Axis axis) { return axis == Axis::x ? 0 : 1; }

/// Returns the axis name in files and messages: "x" or "y".
inline const char* to_string(Axis axis) { return axis == Axis::x ? "x" : "y"; }

}  // namespace kinetix::model
