#include "model/linkage/gripped_rows.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/decompositions.hpp"
#include "model/linkage/probe_thetas.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double straight = 1e-14;  // width of a row over its length, squared: below, it is rounding
constexpr double off = 1e-8;        // cell edges: a row that is meant to bend leaves its plane by far more

Vector3d centre(const std::vector<int>& row, const State& state) {
  Vector3d sum = Vector3d::Zero();
  for (const int body : row) sum += state[body].p;
  return sum / static_cast<double>(row.size());
}

/// Returns the offsets of the bodies in both rows from the centre of their row, one body per column.
Eigen::Matrix3Xd offsets(const GrippedRows& rows, const State& state) {
  Eigen::Matrix3Xd out(3, rows[0].size() + rows[1].size());
  Eigen::Index k = 0;
  for (const auto& row : rows) {
    const Vector3d middle = centre(row, state);
    for (const int body : row) out.col(k++) = state[body].p - middle;
  }
  return out;
}

/// Returns the direction n with the least |points' n| / (n . across). If several have none, the result is the
/// one nearest to `across`.
Vector3d flattest(const Eigen::Matrix3Xd& points, const Vector3d& across) {
  const auto [axes, values] = principal_axes(points * points.transpose());
  const double least = straight * values.sum();
  const Vector3d weights = (values.array().max(0.0) + least).inverse();
  return (axes * weights.cwiseProduct(axes.transpose() * across)).normalized();
}

}  // namespace

RowPlanes planes_of(const GrippedRows& rows, const State& state) {
  const Eigen::Matrix3Xd points = offsets(rows, state);
  const Vector3d across = centre(rows[1], state) - centre(rows[0], state);
  RowPlanes planes;
  planes.normal = flattest(points, across);
  planes.distance = planes.normal.dot(across);
  planes.off_plane = (planes.normal.transpose() * points).cwiseAbs().maxCoeff();
  return planes;
}

bool keeps_between_plates(const Linkage& structure, const GrippedRows& rows,
                          const std::function<State(double)>& fold) {
  const double rest = planes_of(rows, rest_state(structure)).distance;
  const double allowed = off * structure.size.edge_mm;
  return std::all_of(std::begin(probe_thetas), std::end(probe_thetas), [&](double theta) {
    const RowPlanes planes = planes_of(rows, fold(theta));
    return planes.off_plane <= allowed && std::abs(planes.distance - rest * std::cos(theta)) <= allowed;
  });
}

}  // namespace kinetix::model
