#pragma once

#include "targets/curve/curve.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {

/// Largest CSV file, bytes (16 MiB): 80 per allowed point, more than two numbers of full precision need.
inline constexpr std::size_t max_csv_bytes = 16 << 20;
/// Most points of a curve: far finer than cells can follow. The limit refuses wrong files before any work.
inline constexpr std::size_t max_curve_points = 200'000;
/// Largest coordinate, mm, on either side of 0. A kilometre exceeds any sheet, so a point beyond it is in a wrong
/// unit.
inline constexpr double max_coordinate_mm = 1e6;

/// Points of a plane curve as a file has them, mm, with the place of each.
struct PlanePoints {
  std::vector<Eigen::Vector2d> points;
  std::vector<Place> places;
  Place place;  ///< of all
};

/// Points of a space curve as a file has them, mm, with the place of each.
struct SpacePoints {
  std::vector<Eigen::Vector3d> points;  ///< mm
  std::vector<Place> places;
  Place place;  ///< of all
};

/// Returns the type of a key for plane points: a CSV file or a list. @param second_axis name of the coordinate after x
ValueType points_type(const std::string& second_axis);
/// Returns the type of a key for points [x, y, z]: a CSV file or a list. @param most largest number of points
ValueType space_points_type(std::size_t most);

/// Reads points in mm: a list [[x, z], ...], or a CSV file by its path relative to the document's folder.
/// @param second_axis name of the coordinate after x
/// @throws InvalidInput at the point at fault, in the CSV or in the document
PlanePoints read_points(const Node& points, const std::string& second_axis);

/// Reads points in mm: a list [[x, y, z], ...], or a CSV file with the header `x,y,z`. @param most largest number of
/// points
SpacePoints read_space_points(const Node& points, std::size_t most);

/// Reads a CSV file whose first line is the header `x,z` (or `x_mm,z_mm`), then one point per row, mm. Empty lines,
/// lines that start with #, spaces around a number, CRLF and a byte order mark are allowed.
/// @throws InvalidInput naming file:line:column for another header or unit, or a row that is not two finite numbers
/// within a kilometre. More than 200 000 points and more than 16 MiB also throw.
PlanePoints read_points_csv(const std::string& file, const std::string& second_axis);

/// Builds an object from the points by `make`. An InvalidCurve from `make` becomes InvalidInput at the point at fault.
template <class Points, class Make>
auto make_from_points(Points read, const Make& make) {
  try {
    return make(std::move(read.points));
  } catch (const InvalidCurve& e) {
    throw InvalidInput(e.reason(), e.point() < 0 ? read.place : read.places[e.point()]);
  }
}

/// Every key of a `target:` section of kind curve.
const KeyTable& curve_target_keys();

/// Reads the curve under the key `points` (read_points).
/// @throws InvalidInput at the point at fault, in the CSV or in the document, as read_points, or for what Curve
/// refuses
Curve read_curve(const Node& points);

/// Reads a curve from a CSV file (read_points_csv).
/// @throws InvalidInput as read_points_csv, or at the point at fault for what Curve refuses
Curve read_curve_csv(const std::string& file);

}  // namespace kinetix::targets
