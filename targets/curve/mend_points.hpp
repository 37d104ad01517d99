#pragma once

#include "targets/curve/point_files.hpp"

namespace kinetix::targets {

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
