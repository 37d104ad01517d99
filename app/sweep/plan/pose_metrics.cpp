#include "app/sweep/plan/pose_metrics.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <span>

#include "app/run/midline.hpp"
#include "model/assembly/assembly.hpp"
#include "model/base/larger.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Normal of the polygon of a cell's bodies, as long as its area.
Vector3d area_vector(std::span<const int> bodies, const model::State& state) {
  const Vector3d& first = state[bodies[0]].p;
  Vector3d twice = Vector3d::Zero();
  for (std::size_t k = 2; k < bodies.size(); ++k)
    twice += (state[bodies[k - 1]].p - first).cross(state[bodies[k]].p - first);
  return 0.5 * twice;
}

/// Area of all cells; in mm2.
double area(const model::Sheet& structure, const model::State& state) {
  double sum = 0;
  for (int c = 0; c < structure.cells(); ++c) sum += area_vector(structure.cell_bodies(c), state).norm();
  return sum;
}

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

Vector3d extent_of(const model::Assembly& assembly, const model::State& state) {
  if (!is_finite(state)) return Vector3d::Constant(std::nan(""));
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < state.size(); ++b)
    for (const Vector3d& p : assembly.bodies[b].solid.points)
      box.extend(state[b].p + state[b].R * (p - assembly.bodies[b].position));
  return box.sizes();
}

}  // namespace

Vector3d end_point(const model::Sheet&, const model::State& state) {
  return state.back().p - state.front().p;
}

double total_turn(const model::Sheet& structure, const model::State& state) {
  const auto points = column_midline(structure, state);
  double turn = 0;
  for (std::size_t k = 2; k < points.size(); ++k) {
    const Vector2d before = points[k - 1] - points[k - 2], after = points[k] - points[k - 1];
    turn += std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  }
  return turn;
}

double area_ratio(const model::Sheet& structure, const model::State& state) {
  if (!structure.squares()) return area(structure, state) / area(structure, rest_state(structure));
  const double edge = structure.size().edge_mm;
  return area(structure, state) / (static_cast<double>(structure.cells()) * edge * edge);
}

double fold_angle(const model::Sheet& structure, const model::State& state) {
  if (structure.cells() == 0) return std::nan("");
  return angle_between(area_vector(structure.cell_bodies(0), state),
                       area_vector(structure.cell_bodies(structure.cells() - 1), state));
}

double cell_angle(const model::Sheet& structure, const model::State& state) {
  if (structure.cells() == 0) return std::nan("");
  const std::span<const int> b = structure.cell_bodies(0);
  return angle_between(state[b[1]].p - state[b[0]].p, state[b.back()].p - state[b[0]].p);
}

double largest_lean(const model::Sheet& structure, const model::State& state) {
  double largest = 0;
  for (int h = 0; h < structure.hinges(); ++h) {
    const model::HingedWall wall = structure.wall(h);
    largest = larger(largest, angle_between(state[wall.lower].R.col(2), state[wall.upper].R.col(2)));
  }
  return largest;
}

Vector3d extent(const model::Sheet& structure, const model::State& state) {
  if (const model::Assembly* bodies = structure.assembly()) return extent_of(*bodies, state);
  Vector3d low = state[0].p, high = low;
  for (const model::Pose& pose : state) {
    low = low.cwiseMin(pose.p);
    high = high.cwiseMax(pose.p);
    if (!pose.p.allFinite()) return Vector3d::Constant(std::nan(""));
  }
  return high - low;
}

}  // namespace kinetix::app
