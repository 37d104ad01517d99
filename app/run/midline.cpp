#include "app/run/midline.hpp"

namespace kinetix::app {

using Eigen::Vector2d;

std::vector<Vector2d> column_midline(const model::Lattice& structure, const model::State& state) {
  std::vector<Vector2d> points;
  for (const std::vector<int>& column : body_columns(structure)) {
    Vector2d sum = Vector2d::Zero();
    for (const int b : column) sum += Vector2d(state[b].p.x(), state[b].p.z());
    points.push_back(sum / static_cast<double>(column.size()));
  }
  return points;
}

}  // namespace kinetix::app
