#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// Largest overhang that FDM prints without support, degrees from upright (docs/print.md section 3).
constexpr double steep_deg = 45;

/// Returns the largest angle of a hinge axis from upright in the flat sheet, degrees, [0, 90].
double steepest_deg(const PrintSheet& sheet);

/// Returns the area of a solid's faces that look down and lean more than `steep_deg` from upright, mm^2. Faces on the
/// bed do not count. @param turn rotation of the solid before it is put on the bed
double overhang_mm2(const model::Polyhedron& solid, const Eigen::Matrix3d& turn);

/// Orientation on the bed, with its overhang.
struct PrintOrientation {
  std::string_view name;  ///< on the command line
  Eigen::Matrix3d turn;   ///< rotation matrix from the place in the files
  double overhang_mm2 = 0;
};

/// Returns both flat orientations of the hard and soft parts in the job's own state: as in the files (flat), and
/// turned over about x (over). On an edge most bodies would begin in the air.
std::vector<PrintOrientation> lies(const PrintJob& job);
/// Returns the orientation with the least overhang; ties go to the first.
const PrintOrientation& best(const std::vector<PrintOrientation>& all);

/// Turns the solids that `stl`, `3mf` and `step` write.
void lay(PrintJob& job, const PrintOrientation& lie);

}  // namespace kinetix::app
