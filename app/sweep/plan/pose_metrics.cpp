#include "app/sweep/plan/pose_metrics.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "app/run/midline.hpp"
#include "model/base/larger.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Normal of the four bodies of a cell, as long as the area between them.
Vector3d area_vector(const model::CellHinges& cell, const model::State& state) {
  const auto& b = cell.bodies;
  return 0.5 * (state[b[2]].p - state[b[0]].p).cross(state[b[3]].p - state[b[1]].p);
}

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

Vector3d end_point(const model::Structure&, const model::State& state) {
  return state.back().p - state.front().p;
}

double total_turn(const model::Structure& structure, const model::State& state) {
  const auto points = column_midline(structure, state);
  double turn = 0;
  for (std::size_t k = 2; k < points.size(); ++k) {
    const Vector2d before = points[k - 1] - points[k - 2], after = points[k] - points[k - 1];
    turn += std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  }
  return turn;
}

double area_ratio(const model::Structure& structure, const model::State& state) {
  double area = 0;
  for (const model::CellHinges& cell : structure.cell_members) area += area_vector(cell, state).norm();
  const double edge = structure.size.edge_mm;
  return area / (static_cast<double>(structure.cells.size()) * edge * edge);
}

double fold_angle(const model::Structure& structure, const model::State& state) {
  return angle_between(area_vector(structure.cell_members.front(), state),
                       area_vector(structure.cell_members.back(), state));
}

double cell_angle(const model::Structure& structure, const model::State& state) {
  const auto& b = structure.cell_members.front().bodies;
  return angle_between(state[b[1]].p - state[b[0]].p, state[b[3]].p - state[b[0]].p);
}

double largest_lean(const model::Structure& structure, const model::State& state) {
  double largest = 0;
  for (const model::Hinge& hinge : structure.hinges) {
    largest = larger(largest, angle_between(state[hinge.lower].R.col(2), state[hinge.upper].R.col(2)));
  }
  return largest;
}

Vector3d extent(const model::State& state) {
  Vector3d low = state[0].p, high = low;
  for (const model::Pose& pose : state) {
    low = low.cwiseMin(pose.p);
    high = high.cwiseMax(pose.p);
    if (!pose.p.allFinite()) return Vector3d::Constant(std::nan(""));
  }
  return high - low;
}

}  // namespace kinetix::app
