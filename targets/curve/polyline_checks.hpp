#pragma once

#include <Eigen/Core>
#include <vector>

#include "targets/curve/curve.hpp"

namespace kinetix::targets {

/// @throws InvalidCurve for fewer than 3 points, a point that is not finite or the same as the one before
void check_points(const std::vector<Eigen::Vector2d>& points);

/// @throws InvalidCurve for a polyline that crosses or touches itself; the first point may come again as the last
void check_crossing(const std::vector<Eigen::Vector2d>& points);

/// Of point k, that is as the one before.
InvalidCurve repeated_point(std::size_t k);

}  // namespace kinetix::targets
