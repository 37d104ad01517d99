#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/planar/regular_lattices.hpp"

/// Drawings and motions of planar structures for tests and figures.
namespace kinetix::testing {

/// cells x cells squares whose corners are moved at random by up to 0.3 of a wall both ways.
inline model::PlanarGraph random_quads(int cells, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-0.3, 0.3);
  model::PlanarGraph graph = model::square_graph(cells, cells);
  for (Eigen::Vector2d& p : graph.vertices) p += Eigen::Vector2d(by(random), by(random));
  return graph;
}

/// cells x cells rectangles: columns and rows grow by a factor from each to the next, from 1.
inline model::PlanarGraph growing_squares(int cells, double growth) {
  model::PlanarGraph graph = model::square_graph(cells, cells);
  const auto stretched = [=](double at) { return (std::pow(growth, at) - 1) / (growth - 1); };
  for (Eigen::Vector2d& p : graph.vertices) p = {stretched(p.x()), stretched(p.y())};
  return graph;
}

/// Returns the cells x cells squares whose corners are all inside the inscribed circle.
inline model::PlanarGraph disc_of_squares(int cells) {
  const Eigen::Vector2d middle = Eigen::Vector2d::Constant(cells / 2.0);
  return trimmed(model::square_graph(cells, cells),
                 [&](const Eigen::Vector2d& p) { return (p - middle).norm() <= cells / 2.0; });
}

/// Returns a motion with |s| and |2 o| of up to about `size`.
inline model::ParallelDrawing random_redrawing(const model::PlanarStructure& s, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-size / 3, size / 3);
  model::ParallelDrawing y(s.graph.vertices.size());
  for (Eigen::Vector2d& p : y) p = {by(random), by(random)};
  return y;
}

/// Returns the lowest and the highest row of vertices, which plates normal to y grip.
inline std::vector<std::vector<int>> boundary_rows(const model::PlanarGraph& graph) {
  const auto by_y = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.y() < b.y(); };
  const auto [low, high] = std::minmax_element(graph.vertices.begin(), graph.vertices.end(), by_y);
  constexpr double near = 1e-6;  // wall lengths: rounding of a drawing is far below, its rows are far apart
  std::vector<std::vector<int>> rows(2);
  for (int v = 0; v < static_cast<int>(graph.vertices.size()); ++v) {
    if (graph.vertices[v].y() < low->y() + near) rows[0].push_back(v);
    if (graph.vertices[v].y() > high->y() - near) rows[1].push_back(v);
  }
  return rows;
}

}  // namespace kinetix::testing
