#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// What FDM prints without support, degrees from upright (docs/print.md section 3).
constexpr double steep_deg = 45;

/// Largest angle of a hinge axis from upright when the sheet is flat, degrees, [0, 90].
double steepest_deg(const PrintSheet& sheet);

/// Area of a solid's faces that look down and lean more than `steep_deg` from upright, mm^2, those on the bed aside.
/// @param turn of the solid before it is put on the bed, a rotation
double overhang_mm2(const model::Polyhedron& solid, const Eigen::Matrix3d& turn);

/// A way to lie on the bed, and what hangs over it.
struct Lie {
  std::string_view name;  ///< as the command line says it
  Eigen::Matrix3d turn;   ///< rotation matrix, from the files' own place
  double overhang_mm2 = 0;
};

/// Both ways in which a sheet lies flat, of the hard and soft parts in the job's own state: as the files have it (flat),
/// and turned over about x (over). Standing on an edge most bodies would begin in the air.
std::vector<Lie> lies(const PrintJob& job);
/// That with the least overhang; the first of several.
const Lie& best(const std::vector<Lie>& all);

/// Turns what `stl`, `3mf` and `step` write.
void lay(PrintJob& job, const Lie& lie);

}  // namespace kinetix::app
