#pragma once

#include <Eigen/Core>
#include <vector>

#include "targets/curve/curve.hpp"

namespace kinetix::targets {

/// @throws InvalidCurve for fewer than 3 points, a point that is not finite or the same as the one before
template <class Point>  // Eigen::Vector2d, Eigen::Vector3d
void check_points(const std::vector<Point>& points);

/// Of the diagonal of the box round a curve: parts of a curve that are closer meet, but for rounding.
constexpr double touching = 1e-9;

/// @throws InvalidCurve for a polyline whose ends meet
template <class Point>
void check_open(const std::vector<Point>& points);

/// @throws InvalidCurve for a polyline that crosses or touches itself; the first point may come again as the last
void check_crossing(const std::vector<Eigen::Vector2d>& points);

/// Of point k, that is as the one before.
InvalidCurve repeated_point(std::size_t k);
/// At point k, where the curve runs back over its last segment.
InvalidCurve turns_back(std::size_t k);
/// Of segment `first` with the later `second`; @param closes whether that one ends at the first point
InvalidCurve crosses_itself(std::size_t first, std::size_t second, bool closes);

}  // namespace kinetix::targets
