#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::targets {

/// A polyline in space by its arc length, which may start below zero. Points and arc lengths in mm.
class SpaceCurve {
 public:
  /// Points that repeat the one before are left out.
  /// @param first arc length at the first point
  /// @pre two different points at least
  explicit SpaceCurve(const std::vector<Eigen::Vector3d>& points, double first = 0);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /// Arc length at each point.
  const std::vector<double>& arcs() const { return arc_; }
  double first() const { return arc_.front(); }
  double last() const { return arc_.back(); }
  double length() const { return last() - first(); }

  /// Point at arc length s, which is clamped to the curve.
  Eigen::Vector3d at(double s) const;
  /// Unit vector along the chord over s - reach to s + reach (cut at the ends): what is left of noise shrinks
  /// with the reach. @pre reach > 0, s on the curve
  Eigen::Vector3d direction(double s, double reach) const;
  /// Arc length of the point nearest to p.
  double nearest(const Eigen::Vector3d& p) const;
  /// The part between two arc lengths, which keep their values. @pre first() <= from < to <= last()
  SpaceCurve part(double from, double to) const;
  /// Points evenly spaced by arc length, both ends among them. @pre count >= 2
  std::vector<Eigen::Vector3d> evenly(int count) const;

 private:
  std::size_t segment_at(double s) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<double> arc_;
};

}  // namespace kinetix::targets
