#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::targets {

/// A closed plane curve as a polygon, counter-clockwise, mm.
class Outline {
 public:
  /// @param points in either sense; the last may repeat the first.
  /// @throws InvalidCurve for fewer than 3 points, a point that is not finite or repeats its neighbour, or an outline
  /// that crosses itself. Points are named by number from 1.
  explicit Outline(std::vector<Eigen::Vector2d> points);

  /// Each once.
  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  double perimeter() const { return arc_.back(); }  ///< mm
  double area() const { return area_; }             ///< mm2
  double diagonal() const { return diagonal_; }     ///< of its smaller bounding box (smallest_diagonal), mm
  const Eigen::Vector2d& middle() const { return middle_; }  ///< of its area

  /// Point at arc length s, mm, from its first point; s is taken round and round.
  Eigen::Vector2d at(double s) const;

  struct Nearest {
    Eigen::Vector2d point;
    Eigen::Vector2d normal;  ///< unit, outwards, of its side; towards p where that is a corner's
    double arc = 0;          ///< mm
    double distance = 0;     ///< mm
  };
  /// The point of the curve that is nearest to p.
  Nearest nearest(const Eigen::Vector2d& p) const;

  bool contains(const Eigen::Vector2d& p) const;

  /// Points at which it turns by more than this, rad, to either side.
  std::vector<Eigen::Vector2d> corners(double turn) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> arc_;  ///< at each point, and of the whole, mm
  double area_ = 0, diagonal_ = 0;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
};

/// Deviation of a polygon from an outline.
struct OutlineError {
  double rms = 0;  ///< of the polygon's corners from the outline, over the outline's diagonal
  double max = 0;  ///< largest distance of the polygon's corners, over the outline's diagonal
  double iou = 0;  ///< area of their intersection over that of their union, [0, 1]
};

/// @param corners of a polygon, counter-clockwise, mm. NaN in them, or a polygon that crosses itself, gives NaN
/// (in rms and max; in iou)
OutlineError outline_error(const Outline& goal, const std::vector<Eigen::Vector2d>& corners);

}  // namespace kinetix::targets
