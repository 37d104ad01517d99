#include "optim/space_block/fit_space_block.hpp"

#include <fmt/format.h>

#include <cmath>

namespace kinetix::optim {
namespace {

constexpr double min_usual_gusset = 0.2;         // of an edge: room for two hinges and a wall between them
constexpr double default_edge_mm = 20;           // mm: walls of blocks then print in their usual size
constexpr int default_cells = 2;                 // along each direction: the fewest with rotors inside
constexpr int fewest_cells = 2, most_cells = 5;  // along the shortest side
constexpr double one_side = 1e-9;  // cell edges: rotors of one side differ by rounding in their distance from
                                   // it

double squared_sine(double theta) { return std::pow(std::sin(theta), 2); }

/// Returns the relative shrinkage of edges in squares normal to x, y and z. A direction shrinks by the mean
/// of the two kinds of edges along it.
Eigen::Vector3d shrinks_of(const Eigen::Vector3d& factors) {
  const Eigen::Vector3d by = Eigen::Vector3d::Ones() - factors;
  return Eigen::Vector3d::Constant(by.sum()) - 2 * by;
}

/// Returns theta, rad. It gives the edges that shrink most gussets of the usual length, or is the nearest
/// theta with all gussets in their range. If there is none, only the range of theta is respected.
double theta_of(const Eigen::Vector3d& shrinks, const SpaceBlockVariables& v) {
  const double least = shrinks.maxCoeff() / (1 - v.gusset[0]), most = shrinks.minCoeff() / (1 - v.gusset[1]),
               usual = shrinks.maxCoeff() / (1 - min_usual_gusset);
  const double squared = least <= most ? std::clamp(usual, least, most) : usual;
  return std::clamp(std::asin(std::sqrt(std::min(1.0, squared))), v.theta.lower, v.theta.upper);
}

Eigen::Vector3d gussets_of(const Eigen::Vector3d& shrinks, double theta) {
  return Eigen::Vector3d::Ones() - shrinks / squared_sine(theta);
}

std::array<int, 3> cells_of(const Eigen::Vector3d& size_mm, double edge_mm) {
  std::array<int, 3> cells;
  for (int d = 0; d < 3; ++d)
    cells[d] = std::max(1, static_cast<int>(std::lround(size_mm[d] / (cubic_cell() * edge_mm))));
  return cells;
}

Eigen::Vector3d lengths(const std::array<int, 3>& cells, double edge_mm) {
  return cubic_cell() * edge_mm * Eigen::Vector3d(cells[0], cells[1], cells[2]);
}

double off(const Eigen::Vector3d& size, const Eigen::Vector3d& asked) {
  return (size - asked).cwiseQuotient(asked).cwiseAbs().maxCoeff();
}

/// Returns the edge at which the cells are nearest to the lengths. The longest is then relatively as much too
/// long as the shortest is too short.
double edge_of(const std::array<int, 3>& cells, const Eigen::Vector3d& asked) {
  const Eigen::Vector3d ratios = lengths(cells, 1).cwiseQuotient(asked);
  return 2 / (ratios.minCoeff() + ratios.maxCoeff());
}

void choose_size(const Eigen::Vector3d& asked, const SpaceBlockVariables& v, double enough,
                 SpaceBlockDesign& out) {
  const auto take = [&](const std::array<int, 3>& cells, double edge_mm) {
    const double miss = off(lengths(cells, edge_mm), asked);
    if (out.edge_mm > 0 && !(miss < out.size_off)) return;
    out.cells = cells;
    out.edge_mm = edge_mm;
    out.size_off = miss;
  };
  if (v.cells) return take(*v.cells, v.edge_mm.value_or(edge_of(*v.cells, asked)));
  if (v.edge_mm) return take(cells_of(asked, *v.edge_mm), *v.edge_mm);
  for (int n = fewest_cells; n <= most_cells && !(out.edge_mm > 0 && out.size_off <= enough); ++n) {
    const std::array<int, 3> cells = cells_of(asked, asked.minCoeff() / (n * cubic_cell()));
    take(cells, edge_of(cells, asked));
  }
}

}  // namespace

double cubic_cell() { return std::sqrt(8.0); }

std::string obstacle(const targets::SpaceBlockGoal& goal, const SpaceBlockVariables& v) {
  const Eigen::Vector3d shrinks = shrinks_of(goal.factors);
  if (!(shrinks.minCoeff() > 0))
    return fmt::format(
        "one direction shrinks by {:g} and the others together by {:g}. Give a direction less than the sum "
        "of the others",
        1 - goal.factors.minCoeff(), 2 - goal.factors.sum() + goal.factors.minCoeff());
  const Eigen::Vector3d gussets = gussets_of(shrinks, theta_of(shrinks, v));
  constexpr double rounding = 1e-12;
  if (gussets.minCoeff() >= v.gusset[0] - rounding && gussets.maxCoeff() <= v.gusset[1] + rounding) return {};
  return fmt::format(
      "no fold angle from {:g} to {:g} deg has all gussets from {:g} to {:g} edges (`variables`): at {:.3g} "
      "deg they are {:.3g} to {:.3g}",
      to_degrees(v.theta.lower), to_degrees(v.theta.upper), v.gusset[0], v.gusset[1],
      to_degrees(theta_of(shrinks, v)), gussets.minCoeff(), gussets.maxCoeff());
}

SpaceBlockDesign fit_space_block(const targets::SpaceBlockGoal& goal, const SpaceBlockVariables& v,
                                 double enough) {
  SpaceBlockDesign out;
  const Eigen::Vector3d shrinks = shrinks_of(goal.factors);
  out.theta = theta_of(shrinks, v);
  out.gusset = gussets_of(shrinks, out.theta);
  if (goal.size_mm) {
    choose_size(*goal.size_mm, v, enough, out);
  } else {
    out.cells = v.cells.value_or(std::array<int, 3>{default_cells, default_cells, default_cells});
    out.edge_mm = v.edge_mm.value_or(default_edge_mm);
  }
  out.size_mm = lengths(out.cells, out.edge_mm);
  return out;
}

model::SodaliteStructure block_of(const SpaceBlockDesign& design, const model::CellSize& size) {
  model::SodaliteStructure block = model::make_sodalite(design.cells, design.gusset.mean(), size);
  for (std::size_t k = 0; k < block.gussets.size(); ++k) {
    const auto [a, b] = block.gussets[k];
    Eigen::Index normal = 0;
    (sodalite_place(block, b) - sodalite_place(block, a)).cwiseAbs().minCoeff(&normal);
    // Fraction from the rotor along the half edge that ends in the middle of the gusset.
    block.hinges[2 * k].t = block.hinges[2 * k + 1].t = 1 - design.gusset[normal];
  }
  return block;
}

std::array<std::array<std::vector<int>, 2>, 3> side_rotors(const model::SodaliteStructure& block) {
  std::array<std::array<std::vector<int>, 2>, 3> out;
  for (int d = 0; d < 3; ++d) {
    double low = INFINITY, high = -INFINITY;
    for (int r = 0; r < static_cast<int>(block.rotors.size()); ++r) {
      low = std::min(low, sodalite_place(block, r)[d]);
      high = std::max(high, sodalite_place(block, r)[d]);
    }
    for (int r = 0; r < static_cast<int>(block.rotors.size()); ++r) {
      const double at = sodalite_place(block, r)[d];
      if (at < low + one_side) out[d][0].push_back(r);
      if (at > high - one_side) out[d][1].push_back(r);
    }
  }
  return out;
}

targets::BlockSides block_sides(const model::SodaliteStructure& block, const model::State& state) {
  targets::BlockSides out;
  const auto rotors = side_rotors(block);
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side)
      for (const int r : rotors[d][side]) out[d][side].push_back(state[r].p);
  return out;
}

}  // namespace kinetix::optim
