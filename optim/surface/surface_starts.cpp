#include "optim/surface/surface_starts.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "model/lattice/origami/fold_mesh.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

/// Directions, middle and size of a folded sheet.
struct Laid {
  Eigen::Matrix3d axes;  ///< columns: along its rows, along its columns, normal
  Vector3d middle;
  Eigen::Vector2d size;  ///< along rows and columns
};

Laid lay(const model::QuadMesh& m, const model::FoldedMesh& folded) {
  Vector3d left = Vector3d::Zero(), right = left, low = left, high = left, all = left;
  const auto at = [&](int i, int j) { return folded.vertices[m.vertex(i, j)]; };
  for (int j = 0; j <= m.rows; ++j) left += at(0, j) / (m.rows + 1), right += at(m.columns, j) / (m.rows + 1);
  for (int i = 0; i <= m.columns; ++i)
    low += at(i, 0) / (m.columns + 1), high += at(i, m.rows) / (m.columns + 1);
  for (const Vector3d& vertex : folded.vertices) all += vertex / static_cast<double>(folded.vertices.size());
  const Vector3d along = right - left, up = high - low;
  Laid out;
  out.middle = all;
  out.size = {along.norm(), up.norm()};
  out.axes.col(2) = along.cross(up).normalized();
  out.axes.col(0) = along.normalized();
  out.axes.col(1) = out.axes.col(2).cross(out.axes.col(0));
  return out;
}

void scale(model::MarchData& d, double along, double up) {
  for (auto* lengths : {&d.bottom_length, &d.west, &d.east})
    for (double& length : *lengths) length *= along;
  for (auto* lengths : {&d.left_length, &d.south, &d.north})
    for (double& length : *lengths) length *= up;
}

model::MarchData signed_miura(int columns, int rows, const MiuraStart& start) {
  model::MarchData d = model::miura(columns, rows, start.angle, start.fold);
  for (double& c : d.rising) c *= start.side;
  for (double& c : d.level) c *= start.side;
  if (start.turn > 0) return d;
  for (double& c : d.level) c = -c;
  for (auto* angles : {&d.left_angle, &d.bottom_angle})
    for (double& angle : *angles) angle = pi - angle;
  return d;
}

int sign_of(double x) { return x < 0 ? -1 : 1; }

}  // namespace

SurfaceStart start_on(const targets::SurfacePatch& patch, int columns, int rows, const MiuraStart& miura) {
  model::MarchData data = signed_miura(columns, rows, miura);
  Laid laid;
  for (int pass = 0; pass < 2; ++pass) {
    const model::MarchedMesh<double> marched = march(data);
    laid = lay(marched.mesh, fold_facets(marched.mesh, 1.0));
    if (pass == 0) scale(data, 2 * patch.half.x() / laid.size.x(), 2 * patch.half.y() / laid.size.y());
  }
  const model::MarchedMesh<double> marched = march(data);
  const model::FoldedMesh folded = fold_facets(marched.mesh, 1.0);
  SurfaceStart out;
  SurfaceVariables& v = out.variables;
  v.columns = columns;
  v.rows = rows;
  v.unit = mean_edge(marched.mesh);
  for (const double c : data.rising) v.rising_sign.push_back(sign_of(c));
  for (const double c : data.level) v.level_sign.push_back(sign_of(c));
  const std::size_t facet = marched.mesh.facet(columns / 2, rows / 2);
  const Vector3d corner = folded.vertices[marched.mesh.vertex(columns / 2, rows / 2)];
  v.turn = laid.axes.transpose() * folded.frames[facet];
  v.shift = laid.axes.transpose() * (corner - laid.middle);
  const double above = laid.axes.col(2).dot(folded.vertices[marched.mesh.vertex(1, 1)] - laid.middle);
  const double under = laid.axes.col(2).dot(folded.vertices[marched.mesh.vertex(2, 1)] - laid.middle);
  out.x = variables_of(v, data, (above - under) / 2);
  return out;
}

}  // namespace kinetix::optim
