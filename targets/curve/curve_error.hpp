#pragma once

#include <Eigen/Core>
#include <vector>

#include "targets/curve/curve.hpp"

namespace kinetix::targets {

/// Distance between a folded midline and a goal curve (formats.md: shape_rms, shape_max).
struct CurveError {
  double rms = 0;       ///< two-sided closest-point distance, over the diagonal of the goal's bounding box
  double max = 0;       ///< the largest of these distances, over the same diagonal
  double scale_mm = 0;  ///< that diagonal
  bool settled = true;  ///< false when the alignment stopped at its iteration limit
  std::vector<Eigen::Vector2d> goal_mm;  ///< the goal's own points, placed over the midline
  std::vector<double> arc_mm;            ///< arc length along the goal of each of its samples
  std::vector<double>
      distance_mm;  ///< signed distance of the sample from the midline, left of the midline > 0
};

/// Both polylines are cut into 20 points a cell, evenly spaced by arc length, ends included. A point's
/// distance is that to the nearest place on the other *polyline* (not to its nearest sample: that would add
/// an error of a fortieth of a cell). The goal is moved rigidly, without reflection, to make the two-sided
/// rms least.
/// @param midline (x, z) of each column of bodies, mm, at least 2; values that are not finite give NaN in rms
/// and max
CurveError curve_error(const std::vector<Eigen::Vector2d>& midline, const Curve& goal);

}  // namespace kinetix::targets
