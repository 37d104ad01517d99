#include "app/print/overhang.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/print/format/parts.hpp"
#include "model/base/angle.hpp"

namespace kinetix::app {
namespace {

constexpr double on_bed_mm = 0.01;  // mm: less than any layer; corners of files are floats

double lowest(const model::Polyhedron& solid, const Eigen::Vector3d& up) {
  double low = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : solid.points) low = std::min(low, up.dot(p));
  return low;
}

}  // namespace

double steepest_deg(const PrintSheet& sheet) {
  double least = 1;
  for (const model::RestHinge& hinge : sheet.linkage.hinges)
    least = std::min(least, std::abs(hinge.axis.z()));
  return to_degrees(std::acos(least));
}

double overhang_mm2(const model::Polyhedron& solid, const Eigen::Matrix3d& turn) {
  const Eigen::Vector3d up = turn.row(2).transpose();
  const double bed = lowest(solid, up) + on_bed_mm, steep = std::sin(steep_deg * radians_per_degree);
  double area = 0;
  for (const auto& [a, b, c] : solid.triangles) {
    const Eigen::Vector3d &p = solid.points[a], &q = solid.points[b], &r = solid.points[c];
    if (up.dot(p) < bed && up.dot(q) < bed && up.dot(r) < bed) continue;
    const Eigen::Vector3d twice = (q - p).cross(r - p);  // outwards, its length twice the area
    // Slightly steeper than the limit, so that walls at 45 degrees do not depend on rounding.
    if (-up.dot(twice) > (steep + 1e-6) * twice.norm()) area += twice.norm() / 2;
  }
  return area;
}

std::vector<PrintOrientation> lies(const PrintJob& laid) {
  PrintJob job = laid;
  job.turned.reset();
  const model::Polyhedron all = joined(hard_part(job), soft_part(job));
  std::vector<PrintOrientation> out{{"flat", Eigen::Matrix3d::Identity()},
                                    {"over", Eigen::Vector3d(1, -1, -1).asDiagonal()}};
  for (PrintOrientation& lie : out) lie.overhang_mm2 = overhang_mm2(all, lie.turn);
  return out;
}

const PrintOrientation& best(const std::vector<PrintOrientation>& all) {
  return *std::min_element(all.begin(), all.end(), [](const PrintOrientation& a, const PrintOrientation& b) {
    return a.overhang_mm2 < b.overhang_mm2;
  });
}

void lay(PrintJob& job, const PrintOrientation& lie) {
  job.turned = job.state();
  for (model::Pose& pose : *job.turned) pose = {lie.turn * pose.R, lie.turn * pose.p};
  job.lie = lie.name;
}

}  // namespace kinetix::app
