#include "optim/outline/refined_shape.hpp"

#include "model/base/box.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

double cross_2d(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Weights of the vertices of a panel that give a place as their mean.
struct PlaceWeights {
  const model::GraphFace* cell = nullptr;
  std::size_t wall = 0;                                     ///< in its cell: from vertex `wall` to the next
  Eigen::Vector3d parts = Eigen::Vector3d::Constant(-1e9);  ///< of the cell's middle and the wall's ends

  Vector2d mean(const std::vector<Vector2d>& places) const {
    const std::size_t count = cell->vertices.size();
    Vector2d middle = Vector2d::Zero();
    for (const int v : cell->vertices) middle += places[v] / static_cast<double>(count);
    return parts[0] * middle + parts[1] * places[cell->vertices[wall]] +
           parts[2] * places[cell->vertices[(wall + 1) % count]];
  }
};

/// Returns the weights in the triangle that contains the place, or is nearest in the sense of its least weight.
PlaceWeights find_weights(const model::PlanarStructure& panel, const Vector2d& place) {
  const std::vector<Vector2d>& at = panel.graph.vertices;
  PlaceWeights best;
  for (const model::GraphFace& cell : panel.faces) {
    const std::size_t count = cell.vertices.size();
    Vector2d middle = Vector2d::Zero();
    for (const int v : cell.vertices) middle += at[v] / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d a = at[cell.vertices[k]] - middle, b = at[cell.vertices[(k + 1) % count]] - middle;
      const double twice = cross_2d(a, b);
      if (!(twice > 0)) continue;
      const double part_a = cross_2d(place - middle, b) / twice, part_b = cross_2d(a, place - middle) / twice;
      const Eigen::Vector3d parts(1 - part_a - part_b, part_a, part_b);
      if (parts.minCoeff() > best.parts.minCoeff()) best = {&cell, k, parts};
    }
  }
  return best;
}

}  // namespace

OutlineShape refined_shape(const model::PlanarStructure& coarse, const OutlineShape& shape,
                           const model::PlanarStructure& fine) {
  const Eigen::AlignedBox2d from = model::box_of(fine.graph.vertices),
                            to = model::box_of(coarse.graph.vertices);
  const Vector2d stretch = to.sizes().cwiseQuotient(from.sizes());
  const double ratio = std::sqrt(stretch.x() * stretch.y());  // coarse cell edges per fine cell edge
  OutlineShape out;
  out.scale = ratio * shape.scale;
  for (const Vector2d& p : fine.graph.vertices) {
    const PlaceWeights weights =
        find_weights(coarse, to.center() + (p - from.center()).cwiseProduct(stretch));
    out.folded.push_back(weights.mean(shape.folded) / ratio);
    out.flat.push_back(weights.mean(shape.flat) * (coarse.size.edge_mm / fine.size.edge_mm));
  }
  return out;
}

}  // namespace kinetix::optim
