#pragma once

#include "model/linkage/state.hpp"
#include "targets/curve/curve.hpp"
#include "targets/curve/read_curve.hpp"
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

/// Distance between a folded midline in space and a goal (formats.md: shape_rms, shape_max).
struct SpaceError {
  double rms = 0;       ///< two-sided closest-point distance, over the diagonal of the goal's bounding box
  double max = 0;       ///< the largest of these distances, over the same diagonal
  double scale_mm = 0;  ///< that diagonal
  bool settled = true;  ///< false when the alignment stopped at its iteration limit
  std::vector<Eigen::Vector3d> goal_mm;  ///< the goal's own points, placed over the midline
  std::vector<double> arc_mm;            ///< arc length along the goal of each of its samples
  std::vector<double> distance_mm;       ///< of the sample from the midline
};

/// Both polylines are cut into 20 points a cell, evenly spaced by arc length, ends included; a point's distance is
/// that to the nearest place on the other polyline. The goal is moved rigidly, without reflection, from where
/// `place` has it, until the two-sided rms is least.
/// @param midline middle of each column of bodies, mm, at least 2; values that are not finite give NaN in rms and max
SpaceError space_error(const std::vector<Eigen::Vector3d>& midline, const SpaceGoal& goal,
                       const model::Pose& place);

/// Points of a goal in space: ten a column of the longest strip; nearest points are sought among all of them.
inline constexpr std::size_t max_space_points = 5000;

/// Every key of a `target:` section of kind space_curve.
const KeyTable& space_curve_target_keys();

/// Reads the goal of a target section (read_space_points). @param notes for what is mended.
/// @param checks_size see GoalPoints.
/// @throws InvalidInput at the point at fault, in the CSV or in the document, as read_space_points, or for what
/// SpaceGoal refuses
SpaceGoal read_space_goal(const Section& target, bool checks_size, std::vector<std::string>& notes);

}  // namespace kinetix::targets
