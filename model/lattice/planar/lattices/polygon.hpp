#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::model {

/// Regular polygon with walls of length 1 round a middle, its first corner at the angle `first` from there,
/// rad; counter-clockwise, cell edges.
std::vector<Eigen::Vector2d> regular_polygon(int walls, double first, const Eigen::Vector2d& middle);

}  // namespace kinetix::model
