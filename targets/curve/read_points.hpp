#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "targets/curve/curve.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {

/// Bytes of a CSV file, 16 MiB: 80 for each of the points allowed, more than two numbers in full precision
/// take.
inline constexpr std::size_t max_csv_bytes = 16 << 20;
/// Points of a curve: far finer than cells can follow; a limit so that a wrong file is refused, not worked
/// on.
inline constexpr std::size_t max_curve_points = 200'000;
/// mm, either way from 0: a kilometre is larger than any sheet, so that a point beyond it is a wrong unit.
inline constexpr double max_coordinate_mm = 1e6;

/// Points of a plane as a file has them, mm, and where each stands.
struct PlanePoints {
  std::vector<Eigen::Vector2d> points;
  std::vector<Place> places;
  Place place;  ///< of all
};

/// Likewise of space, mm.
struct SpacePoints {
  std::vector<Eigen::Vector3d> points;  ///< mm
  std::vector<Place> places;
  Place place;  ///< of all
};

/// What may stand under a key for points. @param second_axis name of the second coordinate, after x
ValueType points_type(const std::string& second_axis);
/// Likewise for points [x, y, z]. @param most of them
ValueType space_points_type(std::size_t most);

/// The path of a CSV file, relative to the document's folder, or a list [[x, z], ...], in mm.
/// @throws InvalidInput at the point at fault, in the CSV or in the document
PlanePoints read_points(const Node& points, const std::string& second_axis);

/// Likewise a list [[x, y, z], ...], or a CSV file with the header `x,y,z`. @param most of them
SpacePoints read_space_points(const Node& points, std::size_t most);

/// A CSV file whose first line is the header `x,z` (or `x_mm,z_mm`), then one point a row, mm. Empty lines,
/// lines that start with #, spaces around a number, CRLF and a byte order mark are fine.
/// @throws InvalidInput naming file:line:column for another header or unit, a row that is not two finite
/// numbers within a kilometre, more than 200 000 points, or more than 16 MiB
PlanePoints read_points_csv(const std::string& file, const std::string& second_axis);

/// What `make` makes of the points; what it refuses gets the place of the point at fault.
template <class Points, class Make>
auto made_of(Points read, const Make& make) {
  try {
    return make(std::move(read.points));
  } catch (const InvalidCurve& e) {
    throw InvalidInput(e.reason(), e.point() < 0 ? read.place : read.places[e.point()]);
  }
}

}  // namespace kinetix::targets
