#include "model/opening/wall_overlaps.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/angle.hpp"

namespace kinetix::model {
namespace {

/// Returns the overlap of walls that leave a vertex at these angles, rad. Between two neighbours it is the
/// part of each beyond the line half-way between them: a triangle.
WallOverlap overlap_of_walls(std::vector<double> angles, double half_thickness) {
  std::sort(angles.begin(), angles.end());
  WallOverlap all;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double next = k + 1 < angles.size() ? angles[k + 1] : angles[0] + 2 * pi;
    const double half = (next - angles[k]) / 2;
    if (half >= pi / 2) continue;
    const double area = half_thickness * half_thickness / std::tan(half);
    // Centroid of both triangles along the line: a third of the sum of their corners.
    const double out = half_thickness * (2 * std::sin(half) + std::cos(half) / std::tan(half)) / 3;
    all.area += area;
    all.middle += area * out * Eigen::Vector2d(std::cos(angles[k] + half), std::sin(angles[k] + half));
  }
  if (all.area > 0) all.middle /= all.area;
  return all;
}

}  // namespace

std::vector<WallOverlap> wall_overlaps(const Linkage& panel) {
  std::vector<std::vector<double>> angles(panel.bodies.size());
  for (const Plate& p : panel.plates) angles[p.body].push_back(std::atan2(p.edge.y(), p.edge.x()));
  std::vector<WallOverlap> overlaps;
  for (std::vector<double>& of_body : angles)
    overlaps.push_back(
        overlap_of_walls(std::move(of_body), panel.size.thickness_mm / panel.size.edge_mm / 2));
  return overlaps;
}

}  // namespace kinetix::model
