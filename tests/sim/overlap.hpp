#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "model/lattice/square/structure.hpp"
#include "model/linkage/state.hpp"
#include "sim/shapes/part_shape.hpp"

namespace kinetix::testing {

/// Edge directions of a prism of wall_prisms: along the wall, across it, up, and the cut at the hinge.
inline std::array<Eigen::Vector3d, 4> edges(const sim::Prism& p) {
  return {p[1] - p[0], p[2] - p[0], p[4] - p[0], p[5] - p[1]};
}

/// Overlap of two prisms along the axis of least overlap (separating axes), negative where they are apart.
inline double overlap(const sim::Prism& a, const sim::Prism& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto try_axis = [&](const Eigen::Vector3d& axis) {
    if (axis.norm() < 1e-6) return;
    const auto span = [&](const sim::Prism& p) {
      std::pair range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
      for (const Eigen::Vector3d& corner : p) {
        const double at = corner.dot(axis) / axis.norm();
        range = {std::min(range.first, at), std::max(range.second, at)};
      }
      return range;
    };
    const auto [a0, a1] = span(a);
    const auto [b0, b1] = span(b);
    least = std::min(least, std::min(a1 - b0, b1 - a0));
  };
  for (const auto* p : {&a, &b})
    for (const Eigen::Vector3d& e : edges(*p))
      for (const Eigen::Vector3d& f : edges(*p)) try_axis(e.cross(f));
  for (const Eigen::Vector3d& e : edges(a))
    for (const Eigen::Vector3d& f : edges(b)) try_axis(e.cross(f));
  return least;
}

/// Deepest overlap of two half walls of different bodies and hinges in a state, cell edges.
inline double deepest_overlap(const model::Structure& structure, const model::State& state) {
  struct Placed {
    int body, hinge;
    sim::Prism prism;
  };
  std::vector<Placed> placed;
  const auto walls = sim::wall_prisms(structure);
  for (std::size_t b = 0; b < walls.size(); ++b)
    for (const sim::WallPrism& wall : walls[b]) {
      placed.push_back({static_cast<int>(b), wall.hinge, wall.prism});
      for (Eigen::Vector3d& corner : placed.back().prism)
        corner = state[b].p / structure.size.edge_mm + state[b].R * corner;
    }
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Placed& a : placed)
    for (const Placed& b : placed)
      if (a.body < b.body && a.hinge != b.hinge && (a.prism[0] - b.prism[0]).norm() < 2.5)
        deepest = std::max(deepest, overlap(a.prism, b.prism));
  return deepest;
}

}  // namespace kinetix::testing
