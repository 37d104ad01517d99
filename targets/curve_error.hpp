#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix {

/// Distance between a folded midline and a goal curve (contracts.md: shape_rms, shape_max).
struct CurveError {
  double rms = 0;  ///< two-sided closest-point distance, over the diagonal of the goal's bounding box
  double max = 0;
  double scale_mm = 0;                   ///< that diagonal
  std::vector<Eigen::Vector2d> goal_mm;  ///< the goal's own points, placed over the midline
  std::vector<double> arc_mm;            ///< arc length along the goal of each sample
  std::vector<double> distance_mm;  ///< signed distance of the sample to the midline, left of the goal > 0
};

class Curve;

/// Both polylines are cut into evenly spaced points (at least 20 a cell); each point's distance is that to
/// the nearest place on the other *polyline*; the goal is moved rigidly, without reflection, to make the
/// two-sided rms least.
/// @param midline (x, z) of each column of bodies, mm, at least 2; NaN gives NaN in rms and max
CurveError curve_error(const std::vector<Eigen::Vector2d>& midline, const Curve& goal);

}  // namespace kinetix
