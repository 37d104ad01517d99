#pragma once

#include <vector>

#include "targets/curve/curve.hpp"
#include "targets/curve/space_curve.hpp"

namespace kinetix::targets {

/// An open curve in space that a strip is to take, mm.
class SpaceGoal {
 public:
  /// @throws InvalidCurve for fewer than 3 points, or a point that is not finite or equal to the one before. It also
  /// throws for a curve that is closed, or that turns back on itself at a point (by more than 170 degrees). A curve
  /// that comes as near to itself as a billionth of its diagonal throws too. Points are named by number from 1.
  explicit SpaceGoal(std::vector<Eigen::Vector3d> points);

  const SpaceCurve& line() const { return line_; }
  const std::vector<Eigen::Vector3d>& points() const { return line_.points(); }
  double length() const { return line_.length(); }  ///< mm
  double diagonal() const { return diagonal_; }     ///< of the axis-aligned bounding box, mm

 private:
  double diagonal_ = 0;  // before line_, which is made while it is measured
  SpaceCurve line_;
};

/// Distance of two closed segments ab and cd.
double segment_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                        const Eigen::Vector3d& d);

}  // namespace kinetix::targets
