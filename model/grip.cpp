#include "model/grip.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

using Eigen::Vector3d;

constexpr double probe_thetas[] = {0.2, 0.5, 0.9};
constexpr double straight = 1e-14;  // width of a row over its length, squared
constexpr double off = 1e-8;        // cell edges

Vector3d centre(const std::vector<int>& row, const State& state) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : row) sum += state[body].p;
  return sum / static_cast<double>(row.size());
}

/// Of both rows, each from its centre, one a column.
Eigen::Matrix3Xd offsets(const GrippedRows& rows, const State& state) {
  Eigen::Matrix3Xd out(3, rows[0].size() + rows[1].size());
  Eigen::Index k = 0;
  for (const auto& row : rows) {
    const Vector3d middle = centre(row, state);
    for (const int body : row) out.col(k++) = state[body].p - middle;
  }
  return out;
}

/// The direction n with the least |points' n| over n . across; where several have none, that nearest to
/// across.
Vector3d flattest(const Eigen::Matrix3Xd& points, const Vector3d& across) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(points * points.transpose());
  const double least = straight * spread.eigenvalues().sum();
  const Vector3d weights = (spread.eigenvalues().array().max(0.0) + least).inverse();
  const Eigen::Matrix3d& axes = spread.eigenvectors();
  return (axes * weights.cwiseProduct(axes.transpose() * across)).normalized();
}

/// The whole structure's first and last row.
Grip extent(const Structure& structure) {
  Grip all{structure.bodies.front(), structure.bodies.front()};
  for (const Vertex v : structure.bodies) {
    all.first = {std::min(all.first.i, v.i), std::min(all.first.j, v.j)};
    all.last = {std::max(all.last.i, v.i), std::max(all.last.j, v.j)};
  }
  return all;
}

void require_vertex(Vertex v, const Grip& grip, const Structure& structure) {
  if (structure.body_at(v)) return;
  throw InvalidInput("plates cannot grip " + to_string(grip) + ": the structure has no vertex " +
                     to_string(v) + "; their first and last row of vertices must be there");
}

}  // namespace

std::string to_string(const Grip& grip) {
  return "[" + to_string(grip.first) + ", " + to_string(grip.last) + "]";
}

void validate(const Grip& grip, Axis axis, const Structure& structure) {
  if (!(grip.first.i < grip.last.i && grip.first.j < grip.last.j))
    throw InvalidInput("the rectangle " + to_string(grip) +
                       " must span at least one cell both ways: its lower left vertex, then its upper right");
  const bool along_x = axis == Axis::x;
  const int begin = along_x ? grip.first.j : grip.first.i, end = along_x ? grip.last.j : grip.last.i;
  for (int k = begin; k <= end; ++k) {
    require_vertex(along_x ? Vertex{grip.first.i, k} : Vertex{k, grip.first.j}, grip, structure);
    require_vertex(along_x ? Vertex{grip.last.i, k} : Vertex{k, grip.last.j}, grip, structure);
  }
}

GrippedRows gripped_bodies(const Structure& structure, Axis axis, const std::optional<Grip>& grip) {
  const Grip held = grip.value_or(extent(structure));
  GrippedRows rows;
  for (int b = 0; b < static_cast<int>(structure.bodies.size()); ++b) {
    const Vertex v = structure.bodies[b];
    if (!held.contains(v)) continue;
    if (row_along(axis, v) == row_along(axis, held.first)) rows[0].push_back(b);
    if (row_along(axis, v) == row_along(axis, held.last)) rows[1].push_back(b);
  }
  return rows;
}

RowPlanes planes_of(const GrippedRows& rows, const State& state) {
  const Eigen::Matrix3Xd points = offsets(rows, state);
  const Vector3d across = centre(rows[1], state) - centre(rows[0], state);
  RowPlanes planes;
  planes.normal = flattest(points, across);
  planes.distance = planes.normal.dot(across);
  planes.off_plane = (planes.normal.transpose() * points).cwiseAbs().maxCoeff();
  return planes;
}

bool keeps_between_plates(const Structure& structure, const GrippedRows& rows,
                          const std::function<State(double)>& fold) {
  const double rest = planes_of(rows, rest_state(structure)).distance;
  const double allowed = off * structure.size.edge_mm;
  return std::all_of(std::begin(probe_thetas), std::end(probe_thetas), [&](double theta) {
    const RowPlanes planes = planes_of(rows, fold(theta));
    return planes.off_plane <= allowed && std::abs(planes.distance - rest * std::cos(theta)) <= allowed;
  });
}

}  // namespace kinetix
