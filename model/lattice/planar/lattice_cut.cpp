#include "model/lattice/planar/lattice_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "model/base/union_find.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

// Extra columns around the rectangle, and extra pairs of rows, which are lower: room for slightly larger regions.
constexpr int margin = 2;
// Cell edges: nearer middles of walls are equal. Rounding is 1e-13 and walls are far apart.
constexpr double one_wall = 1e-4;

Vector2d middle_of(const PlanarLattice& lattice, const LatticeCell& cell, double angle) {
  const std::vector<Vector2d> corners = lattice.corners(cell[0], cell[1], angle);
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& corner : corners) sum += corner;
  return sum / static_cast<double>(corners.size());
}

std::pair<long, long> key(const Vector2d& p) {
  return {std::lround(p.x() / one_wall), std::lround(p.y() / one_wall)};
}

std::vector<LatticeCell> largest_cells(const PlanarLattice& lattice, double angle,
                                       const std::vector<LatticeCell>& cells) {
  UnionFind pieces(cells.size());
  std::map<std::pair<long, long>, int> cell_at;  // by middles of walls
  for (int c = 0; c < static_cast<int>(cells.size()); ++c) {
    const auto corners = lattice.corners(cells[c][0], cells[c][1], angle);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto wall = key((corners[k] + corners[(k + 1) % corners.size()]) / 2);
      if (const auto [at, is_new] = cell_at.try_emplace(wall, c); !is_new) pieces.unite(at->second, c);
    }
  }
  std::vector<LatticeCell> kept;
  for (const int c : pieces.largest()) kept.push_back(cells[c]);
  return kept;
}

std::vector<LatticeCell> from_zero(std::vector<LatticeCell> cells) {
  LatticeCell low = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  for (const LatticeCell& cell : cells) low = {std::min(low[0], cell[0]), std::min(low[1], cell[1])};
  low[1] -= odd_row(low[1]);
  for (LatticeCell& cell : cells) cell = {cell[0] - low[0], cell[1] - low[1]};
  std::sort(cells.begin(), cells.end(), [](const LatticeCell& a, const LatticeCell& b) {
    return std::pair(a[1], a[0]) < std::pair(b[1], b[0]);
  });
  return cells;
}

}  // namespace

LatticePitch lattice_pitch(const PlanarLattice& lattice, double angle) {
  const Vector2d first = middle_of(lattice, {0, 0}, angle);
  return {middle_of(lattice, {1, 0}, angle) - first, (middle_of(lattice, {0, 2}, angle) - first) / 2};
}

Eigen::AlignedBox2d lattice_box(const PlanarLattice& lattice, int columns, int rows, double angle) {
  Eigen::AlignedBox2d box;
  for (const auto& [i, j] : lattice_cells(columns, rows))
    for (const Vector2d& corner : lattice.corners(i, j, angle)) box.extend(corner);
  return box;
}

std::vector<LatticeCell> cut_cells(const PlanarLattice& lattice, int columns, int rows, double angle,
                                   const std::function<bool(const Vector2d&)>& inside) {
  std::vector<LatticeCell> cells;
  for (int j = -2 * margin; j < rows + 2 * margin; ++j)
    for (int i = -margin; i < columns + margin; ++i)
      if (inside(middle_of(lattice, {i, j}, angle))) cells.push_back({i, j});
  return from_zero(largest_cells(lattice, angle, cells));
}

}  // namespace kinetix::model
