#pragma once

#include "targets/curve/read_curve.hpp"

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

/// Returns the direction of the area within an outline, rad, which turns with it. The first of the moments integral (z
/// - middle)^n dA, n = 2 to 6, that does not vanish gives n directions, with z = x + i y. The result is the one
/// towards which most of the area lies far out (integral of |z - middle|^2 (z - middle) dA). Ties go to the direction
/// nearest to the outline's first point. Empty for a disc, whose directions are all equal.
std::optional<double> direction_of(const Outline& outline);

/// Returns the smaller diagonal of two bounding boxes, mm: square to direction_of, and at 45 deg to it. It does not
/// depend on how the outline is turned. A disc gives the diagonal of the axis-aligned box.
double smallest_diagonal(const Outline& outline);

/// Returns the outline turned about the origin. @param angle rad, counter-clockwise; 0 leaves it as it is
Outline turned(const Outline& outline, double angle);

/// Returns every key of a `target:` section of kind outline.
const KeyTable& outline_target_keys();

/// Reads the outline under a key of a target section. @param notes to which what was mended is added
/// @param checks_size see GoalPoints
Outline read_outline(const Section& target, std::string_view key, bool checks_size,
                     std::vector<std::string>& notes);
/// Reads an outline from a value of such a key (read_points, with the second axis y).
/// @throws InvalidInput at the point at fault, in the CSV or in the document, as read_points, or for what Outline
/// refuses
Outline read_outline(const Node& points);

}  // namespace kinetix::targets
