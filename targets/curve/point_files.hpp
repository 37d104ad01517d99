#pragma once

#include <Eigen/Core>

#include "model/base/invalid_input.hpp"

namespace kinetix::targets {

/// Largest CSV file, bytes (16 MiB): 80 per allowed point, more than two numbers of full precision need.
inline constexpr std::size_t max_csv_bytes = 16 << 20;
/// Most points of a curve: far finer than cells can follow. The limit refuses wrong files before any work.
inline constexpr std::size_t max_curve_points = 200'000;
/// Largest coordinate, mm, on either side of 0. A kilometre exceeds any sheet, so a point beyond it is in a wrong
/// unit.
inline constexpr double max_coordinate_mm = 1e6;

/// Points of a file, in its unit. Points of a plane have z = 0.
struct FilePoints {
  std::vector<Eigen::Vector3d> points;
  std::vector<Place> places;  ///< of each point
  Place place;                ///< of all
  std::vector<std::string> notes = {};
  std::optional<double> unit_mm = {};  ///< mm in one unit; empty: the file does not give it
  bool in_pixels = false;              ///< a picture: its size is not known
};

/// Coordinates of the points of a goal.
struct PointForm {
  std::vector<std::string> axes;  ///< "x" and the name of the second, or "x", "y" and "z"
  std::size_t most = max_curve_points;
  bool is_closed = false;  ///< an outline, also of a picture
};

/// Reads a file of points. Its ending decides the format.
///   - .svg and .dxf: the only path of a drawing, in its unit, y or z upwards.
///   - .png, .jpg, .jpeg, .pbm and .pgm: the outline of the largest silhouette, for outlines alone.
///   - .gpx: a track or route as a map, in metres from its first point. The height is z in space.
///   - all others: a table of numbers (read_point_table).
/// @throws InvalidInput naming the file, and the line of text formats
FilePoints read_point_file(const std::string& file, const PointForm& form);

/// Reads a table with one point per line. Columns are separated by commas, semicolons, tabs or blanks. A decimal comma
/// is allowed unless columns are separated by commas. The first line may be a header such as `x,z`, `X;Y` or
/// `x_cm,z_cm`, or the name of an airfoil in Selig's form. Empty lines, lines that start with #, CRLF and a byte order
/// mark are allowed.
/// @throws InvalidInput naming file:line:column for another header, or a row of other than finite numbers within a
/// kilometre. More points than the form allows and more than 16 MiB also throw.
FilePoints read_point_table(const std::string& file, const PointForm& form);

/// Text for keys and messages: the files that read_point_file reads.
inline constexpr const char* point_files = "a CSV, SVG, DXF, GPX or DAT file";

/// How the points of a goal are mended and checked.
struct PointRequest {
  bool is_closed = false;    ///< an outline
  bool smooth = false;       ///< a smooth curve goes through the points
  double average_mm = 0;     ///< length along the line over which points are averaged before; 0: none
  bool checks_size = false;  ///< whether a size below 2 mm or above 10 m is refused
};

/// Mends points in mm, and adds a note for each kind of change. Points that repeat their neighbour are merged, and
/// spikes of less than 0.1 mm are removed. Smooth curves have up to eight points per given one.
/// @param size_in_file largest side of the box of all points, in the unit of the file. It is for advice.
/// @throws InvalidInput at the points for a size that is to be checked, and for an outline with an open end
void mend_points(FilePoints& points, const PointRequest& request, double size_in_file);

/// Returns advice if points are noisy: their line is far longer than their box, and turns sharply at most points.
/// Empty if they are not.
std::string advise_on_noise(const std::vector<Eigen::Vector3d>& points);

}  // namespace kinetix::targets
