#include "optim/display/driven_hinge.hpp"

#include <cmath>
#include <tuple>

#include "model/linkage/linkage_drive.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

constexpr double middle_half = 0.25;  // of the panel's extent, from its middle to either side
constexpr double alike = 1e-6;        // of a wall's length: offsets that differ by less are equal

struct Extent {
  Vector2d middle, size;  ///< cell edges
};

Extent extent_of(const model::PlanarGraph& graph) {
  Vector2d low = graph.vertices.front(), high = low;
  for (const Vector2d& v : graph.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return {(low + high) / 2, high - low};
}

}  // namespace

int middle_hinge(const model::PlanarStructure& panel, const model::Redrawing& y) {
  const Extent extent = extent_of(panel.graph);
  const auto rank = [&](int edge) {
    const auto [from, to] = panel.graph.edges[static_cast<std::size_t>(edge)];
    const Vector2d off = (panel.graph.vertices[from] + panel.graph.vertices[to]) / 2 - extent.middle;
    const bool is_outside = (off.cwiseAbs() - middle_half * extent.size).maxCoeff() > 0;
    const double scaled = is_outside ? 0 : std::round(std::abs(change_of(panel, y, edge).o) / alike);
    return std::tuple(is_outside, scaled, off.norm());
  };
  int best = 0;
  for (int edge = 1; edge < static_cast<int>(panel.graph.edges.size()); ++edge)
    if (rank(edge) < rank(best)) best = edge;
  return best;
}

model::HingeTurn turn_to(const model::PlanarStructure& panel, int hinge, double theta) {
  const int lower = panel.graph.edges[static_cast<std::size_t>(hinge)].from;
  return {hinge, model::turn_at_theta(panel.senses[static_cast<std::size_t>(lower)], theta)};
}

}  // namespace kinetix::optim
