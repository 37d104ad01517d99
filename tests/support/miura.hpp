#pragma once

#include <cmath>
#include <utility>

#include "model/lattice/planar/planar_crease.hpp"
#include "model/lattice/planar/regular_lattices.hpp"

/// Miura's pattern on hexagons, for tests.
namespace kinetix::testing {

/// Returns hexagons in rows. The lines between the middles of hexagons that share a wall halve it at right angles.
/// Middles are 2 cos(angle) apart in a row, and the steps between rows rise by `angle`. At 60 deg the hexagons are
/// regular, times 1 / sqrt(3). Four creases meet in every hexagon: two along its row, and two of a zigzag from row to
/// row.
/// @param angle between both, rad, in (45 deg, 90 deg)   @param multiplier of the zigzags
inline model::PlanarStructure miura_of_hexagons(int columns, int rows, double angle, double multiplier) {
  model::PlanarGraph graph = lattice_graph(model::honeycomb_lattice, columns, rows);
  const double step = 2 * std::cos(angle), rise = std::sin(angle);
  const double corner =
      (rise * rise - step * step / 4) / (2 * rise);  // above two middles of a row, between them
  for (Eigen::Vector2d& p : graph.vertices) {
    const int k = static_cast<int>(std::lround(2 * p.y())), row = static_cast<int>(std::floor(k / 3.0));
    p = {p.x() / std::sqrt(3.0) * step, k - 3 * row == 1 ? row * rise + corner : (row + 1) * rise - corner};
  }
  model::PlanarStructure s = make_planar_structure(std::move(graph), {});
  const auto sign = [](long number) { return number % 2 == 0 ? 1 : -1; };
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
    const auto [from, to] = s.graph.edges[h];
    const Eigen::Vector2d middle = (s.graph.vertices[from] + s.graph.vertices[to]) / 2;
    const double column = middle.x() / step;
    if (std::abs(s.graph.along(h).x()) < 1e-9) {
      const long row = std::lround(middle.y() / rise),
                 left = std::lround(column - 0.5 - (sign(row) < 0 ? 0.5 : 0));
      set_fold(s, h, Eigen::Vector2d::UnitX(), -sign(row) * sign(left) * std::cos(angle) * multiplier);
    } else if (const long zigzag = std::lround(column - 0.25);
               std::abs(column - 0.25 - static_cast<double>(zigzag)) < 0.1) {
      const long row = static_cast<long>(std::floor(middle.y() / rise));
      set_fold(s, h, {sign(row) * std::cos(angle), rise}, sign(zigzag) * multiplier);
    }
  }
  return s;
}

}  // namespace kinetix::testing
