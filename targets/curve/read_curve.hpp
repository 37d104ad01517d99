#pragma once

#include "targets/curve/curve.hpp"
#include "targets/curve/point_files.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {

/// Points of a plane curve as a file has them, mm, with the place of each.
struct PlanePoints {
  std::vector<Eigen::Vector2d> points;
  std::vector<Place> places;
  Place place;                          ///< of all
  std::vector<std::string> notes = {};  ///< what was mended, one sentence each
  std::string advice = {};  ///< for points that no curve can be made of, one sentence; empty: none
};

/// Points of a space curve as a file has them, mm, with the place of each.
struct SpacePoints {
  std::vector<Eigen::Vector3d> points;  ///< mm
  std::vector<Place> places;
  Place place;                          ///< of all
  std::vector<std::string> notes = {};  ///< what was mended, one sentence each
  std::string advice = {};  ///< for points that no curve can be made of, one sentence; empty: none
};

/// Returns the type of a key for plane points: a file or a list. @param second_axis name of the coordinate after x
/// @param is_closed whether a picture may give them
ValueType points_type(const std::string& second_axis, bool is_closed = false);
/// Returns the type of a key for points [x, y, z]: a file or a list. @param most largest number of points
ValueType space_points_type(std::size_t most);
/// Returns the keys `units` and `smooth` of a target with points.
std::vector<Key> point_keys();

/// Form and treatment of the points of a goal.
struct GoalPoints {
  PointForm form = {};
  bool checks_size =
      false;  ///< whether a size below 2 mm or above 10 m is refused, unless the file names its unit
};

/// Reads points in mm: a list [[x, z], ...], or a file by its path relative to the document's folder
/// (read_point_file). They are mended (mend_points).
/// @param second_axis name of the coordinate after x
/// @throws InvalidInput at the point at fault, in the file or in the document
PlanePoints read_points(const Node& points, const std::string& second_axis);
/// Reads points under a key of a target section with point_keys().
PlanePoints read_points(const Section& target, std::string_view key, const GoalPoints& wanted);

/// Reads points in mm of a target section with point_keys(): a list [[x, y, z], ...], or a file.
SpacePoints read_space_points(const Section& target, std::string_view key, const GoalPoints& wanted);

/// Reads the points of a file in mm (read_point_file).
PlanePoints read_points_csv(const std::string& file, const std::string& second_axis);

/// Builds an object from the points by `make`. An InvalidCurve from `make` becomes InvalidInput at the point at fault.
template <class Points, class Make>
auto make_from_points(Points read, const Make& make) {
  try {
    return make(std::move(read.points));
  } catch (const InvalidCurve& e) {
    throw InvalidInput(e.reason() + (read.advice.empty() ? "" : "; " + read.advice),
                       e.point() < 0 ? read.place : read.places[e.point()]);
  }
}

/// Every key of a `target:` section of kind curve.
const KeyTable& curve_target_keys();

/// Reads the curve of a target section. @param notes to which what was mended is added
/// @param checks_size see GoalPoints
Curve read_curve(const Section& target, bool checks_size, std::vector<std::string>& notes);
/// Reads a curve from a value of the key `points`.
/// @throws InvalidInput at the point at fault, in the CSV or in the document, as read_points, or for what Curve
/// refuses
Curve read_curve(const Node& points);

/// Reads a curve from a CSV file (read_points_csv).
/// @throws InvalidInput as read_points_csv, or at the point at fault for what Curve refuses
Curve read_curve_csv(const std::string& file);

}  // namespace kinetix::targets
