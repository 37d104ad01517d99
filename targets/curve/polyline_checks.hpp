#pragma once

#include <Eigen/Core>
#include <vector>

#include "targets/curve/curve.hpp"

namespace kinetix::targets {

/// @throws InvalidCurve for fewer than 3 points, a point that is not finite or the same as the one before
template <class Point>  // Eigen::Vector2d, Eigen::Vector3d
void check_points(const std::vector<Point>& points);

/// Largest gap between parts of a curve that touch, as a fraction of the diagonal of its bounding box. It only covers
/// rounding.
constexpr double touching = 1e-9;

/// @throws InvalidCurve for a polyline whose ends meet
template <class Point>
void check_open(const std::vector<Point>& points);

/// @throws InvalidCurve for a polyline that crosses or touches itself; the first point may come again as the last
void check_crossing(const std::vector<Eigen::Vector2d>& points);

/// Returns the error for point k, which equals point k - 1.
InvalidCurve repeated_point(std::size_t k);
/// Returns the error for point k, where the curve runs back over its last segment.
InvalidCurve turns_back(std::size_t k);
/// Returns the error for segment `first`, which meets the later segment `second`.
/// @param closes whether `second` ends at the first point
InvalidCurve crosses_itself(std::size_t first, std::size_t second, bool closes);

}  // namespace kinetix::targets
