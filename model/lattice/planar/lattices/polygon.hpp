#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::model {

/// Returns a regular polygon with walls of length 1 around a middle, counter-clockwise, cell edges. @param first
/// angle of its first corner from the middle, rad
std::vector<Eigen::Vector2d> regular_polygon(int walls, double first, const Eigen::Vector2d& middle);

}  // namespace kinetix::model
