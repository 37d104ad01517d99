#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/base/invalid_input.hpp"

namespace kinetix::targets {

/// Invalid curve, with the point at fault.
class InvalidCurve : public InvalidInput {
 public:
  InvalidCurve(const std::string& fault_text, int point) : InvalidInput(fault_text), point_(point) {}
  /// Index of the (last) point at fault, from 0; -1 when the whole curve is.
  int point() const { return point_; }

 private:
  int point_;
};

/// An open plane curve as a polyline of (x, z) points, mm.
class Curve {
 public:
  /// @throws InvalidCurve for fewer than 3 points, a point that is not finite, or a repeated neighbour. Neighbours
  /// also count as repeated if the arc length does not grow between them. A closed curve (first point equal to last)
  /// and a self-crossing also throw. The message names the points by number from 1.
  explicit Curve(std::vector<Eigen::Vector2d> points);

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  /// Arc length, mm.
  double length() const { return arc_.back(); }
  /// Diagonal of the axis-aligned bounding box, mm.
  double diagonal() const { return diagonal_; }

  /// Point at arc length s, mm; s is clamped to the curve.
  Eigen::Vector2d at(double s) const;
  /// Heading (rad, unwrapped along the curve) of the segment at arc length s, mm.
  double heading(double s) const;

  /// Index of the segment that holds arc length s, mm.
  int segment_at(double s) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> arc_;      // arc length at each point, mm
  std::vector<double> heading_;  // of each segment, rad
  double diagonal_ = 0;          // of the bounding box, mm
};

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
