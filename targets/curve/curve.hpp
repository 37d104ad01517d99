#pragma once

#include <Eigen/Core>
#include <string>
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

}  // namespace kinetix::targets
