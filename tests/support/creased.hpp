#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/lattice/planar/planar_crease.hpp"
#include "model/lattice/planar/regular_lattices.hpp"
#include "tests/support/planar_graphs.hpp"

/// Planar structures with a crease, for tests.
namespace kinetix::testing {

/// Tilt of a crease's hinges, rad: steep enough that the law is not linear.
constexpr double crease_tilt = 30 * radians_per_degree;

/// Structure whose hinges along one line tilt (kinematics.md section 6).
struct Creased {
  model::PlanarStructure structure;
  double at = 0;  ///< y at rest of the crease, which runs along x, cell edges
  std::vector<int> hinges;
};

inline std::vector<int> walls_across(const model::PlanarGraph& graph, double y) {
  std::vector<int> walls;
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e)
    if ((graph.vertices[graph.edges[e].from].y() - y) * (graph.vertices[graph.edges[e].to].y() - y) < 0)
      walls.push_back(e);
  return walls;
}

/// Returns a crease across the walls that it meets halfway. Their hinges tilt along it, each class to one side.
inline Creased creased(const model::PlanarGraph& graph) {
  Creased out{make_planar_structure(graph, {}), 0, {}};
  model::PlanarStructure& s = out.structure;
  const auto is_upright = [&](int e) { return std::abs(s.graph.along(e).x()) < 1e-9; };
  for (int e = 0; e < static_cast<int>(s.graph.edges.size()); ++e) {
    if (!is_upright(e)) continue;
    const double middle =
        (s.graph.vertices[s.graph.edges[e].from] + s.graph.vertices[s.graph.edges[e].to]).y() / 2;
    const auto is_halved = [&](int wall) {
      const auto [from, to] = s.graph.edges[wall];
      return is_upright(wall) &&
             std::abs((s.graph.vertices[from] + s.graph.vertices[to]).y() / 2 - middle) < 1e-9;
    };
    const std::vector<int> walls = walls_across(s.graph, middle);
    if (walls.size() <= out.hinges.size() || !std::all_of(walls.begin(), walls.end(), is_halved)) continue;
    out.hinges = walls;
    out.at = middle;
  }
  for (const int e : out.hinges) {
    const auto [from, to] = s.graph.edges[e];
    const int lower = s.graph.vertices[from].y() < s.graph.vertices[to].y() ? from : to;
    const int up =
        s.graph.along(e).y() > 0 ? 1 : -1;  // beta leans to the right of the wall from its first vertex
    s.hinges[e].beta = s.senses[lower] * up * crease_tilt;
  }
  return out;
}

/// Returns the planar state with its upper part turned about the crease by rho.
inline model::State folded(const Creased& c, double theta, double rho) {
  model::State state = fold(
      c.structure, model::ParallelDrawing(c.structure.graph.vertices.size(), Eigen::Vector2d::Zero()), theta);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(rho, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Vector3d line(0, c.at * std::cos(theta) * c.structure.size.edge_mm, 0);
  for (std::size_t v = 0; v < state.size(); ++v) {
    if (c.structure.graph.vertices[v].y() < c.at) continue;
    state[v].p = line + turn * (state[v].p - line);
    state[v].R = turn * state[v].R;
  }
  return state;
}

/// Returns the fold angle by the law of creases (kinematics.md section 6), rad.
inline double fold_angle(double theta) { return 2 * std::atan(std::tan(crease_tilt) * std::sin(theta)); }

/// Returns the rms distance from the folded state, whichever way is up.
inline double from_folded(const Creased& c, const model::State& state, double theta) {
  const double rho = fold_angle(theta);
  return std::min(aligned_distance(c.structure, state, folded(c, theta, rho)).rms,
                  aligned_distance(c.structure, state, folded(c, theta, -rho)).rms);
}

/// Returns creased rhombi of angle g. Walls along the columns alternate s = -+cos(g) from row to row; those along rows
/// are halved. Creases run along columns, in which walls tilt by equal amounts on both sides.
inline model::PlanarStructure creased_rhombi(int columns, int rows, double angle) {
  model::PlanarStructure s =
      make_planar_structure(lattice_graph(model::rhombus_lattice, columns, rows, angle), {});
  const Eigen::Vector2d up(std::cos(angle), std::sin(angle));
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
    const auto [from, to] = s.graph.edges[h];
    const Eigen::Vector2d& lower = s.graph.vertices[from];
    const int row = static_cast<int>(std::lround(lower.y() / up.y())),
              column = static_cast<int>(std::lround(lower.x() - row * up.x()));
    if (s.graph.vertices[to].y() - lower.y() > 1e-9)
      s.hinges[h].t = (1 + s.senses[from] * (row % 2 == 0 ? -1 : 1) * std::cos(angle)) / 2;
    else if (column == 1 || column == 3)
      set_fold(s, h, up, column == 1 ? 0.8 : -1.7);
  }
  return s;
}

/// Returns random quadrilaterals. The walls of every second column are mirrored in its middle.
inline model::PlanarGraph mirrored_quads(int cells, unsigned seed) {
  model::PlanarGraph graph = random_quads(cells, seed);
  const auto at = [&](int i, int j) -> Eigen::Vector2d& { return graph.vertices[j * (cells + 1) + i]; };
  for (int j = 0; j <= cells; ++j)
    for (int i = 1; i < cells; i += 2) at(i + 1, j) = {2 * i + 1 - at(i, j).x(), at(i, j).y()};
  return graph;
}

/// Returns mirrored_quads() with creases of random multipliers through all mirrored columns.
inline model::PlanarStructure creased_quads(int cells, unsigned seed) {
  model::PlanarStructure s = make_planar_structure(mirrored_quads(cells, seed), {});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> multiplier(-2, 2);
  for (double middle = 1.5; middle < cells; middle += 2) {
    const double c = multiplier(random);
    for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
      const auto [from, to] = s.graph.edges[h];
      const Eigen::Vector2d sum = s.graph.vertices[from] + s.graph.vertices[to];
      if (std::abs(sum.x() / 2 - middle) < 1e-9) set_fold(s, h, Eigen::Vector2d::UnitY(), c);
    }
  }
  return s;
}

}  // namespace kinetix::testing
