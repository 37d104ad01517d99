#include "optim/outline/trimmed_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "model/base/union_find.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;
using model::LatticeCell;

constexpr int margin = 2;               // columns and rows round the rectangle, for larger outlines
constexpr std::size_t least_cells = 4;  // fewer are no shape
// Of the outline that just fills the rectangle: pixels of a picture change most from one to the next.
constexpr double sizes[] = {1, 0.95, 1.05};
constexpr double shifts[] = {0, 0.5};  // of a column and of a row

struct Box {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;

  void add(const Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Vector2d size() const { return high - low; }
  Vector2d middle() const { return (low + high) / 2; }
};

std::pair<long, long> key(const Vector2d& p) { return {std::lround(p.x() * 1e4), std::lround(p.y() * 1e4)}; }

/// The largest piece that hangs together by walls.
std::vector<LatticeCell> largest_piece(const model::PlanarLattice& lattice, double angle,
                                       const std::vector<LatticeCell>& cells) {
  UnionFind pieces(cells.size());
  std::map<std::pair<long, long>, int> cell_at;  // middles of walls
  for (int c = 0; c < static_cast<int>(cells.size()); ++c) {
    const auto corners = lattice.corners(cells[c][0], cells[c][1], angle);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto wall = key((corners[k] + corners[(k + 1) % corners.size()]) / 2);
      if (const auto [at, is_new] = cell_at.try_emplace(wall, c); !is_new) pieces.unite(at->second, c);
    }
  }
  std::vector<int> count(cells.size(), 0);
  for (int c = 0; c < static_cast<int>(cells.size()); ++c) ++count[pieces.find(c)];
  std::vector<LatticeCell> kept;
  if (cells.empty()) return kept;
  const int largest = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
  for (int c = 0; c < static_cast<int>(cells.size()); ++c)
    if (pieces.find(c) == largest) kept.push_back(cells[c]);
  return kept;
}

std::vector<LatticeCell> from_zero(std::vector<LatticeCell> cells) {
  LatticeCell low = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  for (const LatticeCell& cell : cells) low = {std::min(low[0], cell[0]), std::min(low[1], cell[1])};
  low[1] = model::even_row_up_to(low[1]);
  for (LatticeCell& cell : cells) cell = {cell[0] - low[0], cell[1] - low[1]};
  std::sort(cells.begin(), cells.end(), [](const LatticeCell& a, const LatticeCell& b) {
    return std::pair(a[1], a[0]) < std::pair(b[1], b[0]);
  });
  return cells;
}

}  // namespace

std::vector<std::vector<LatticeCell>> trimmed_cells(const model::PlanarLattice& lattice, double angle,
                                                    int columns, int rows, const targets::Outline& outline) {
  Box rectangle, drawn;
  for (const auto& [i, j] : model::lattice_cells(columns, rows))
    for (const Vector2d& corner : lattice.corners(i, j, angle)) rectangle.add(corner);
  for (const Vector2d& p : outline.points()) drawn.add(p);
  const Vector2d ratio = drawn.size().cwiseQuotient(rectangle.size());
  Vector2d first = Vector2d::Zero(), right = first, up = first;
  for (const Vector2d& corner : lattice.corners(0, 0, angle)) first += corner;
  for (const Vector2d& corner : lattice.corners(1, 0, angle)) right += corner;
  for (const Vector2d& corner : lattice.corners(0, 2, angle)) up += corner;
  const auto walls = static_cast<double>(lattice.corners(0, 0, angle).size());
  std::vector<std::vector<LatticeCell>> found;
  std::set<std::vector<LatticeCell>> known;
  for (const double size : sizes)
    for (const double i_shift : shifts)
      for (const double j_shift : shifts) {
        const double scale = ratio.maxCoeff() / size;  // of the outline a cell edge
        const Vector2d at =
            rectangle.middle() + (i_shift * (right - first) + j_shift / 2 * (up - first)) / walls;
        std::vector<LatticeCell> cells;
        for (int j = -2 * margin; j < rows + 2 * margin; ++j)
          for (int i = -margin; i < columns + margin; ++i) {
            Vector2d middle = Vector2d::Zero();
            // Odd rows may be shifted, and negative numbers have no odd remainder in C++.
            const Vector2d down = 2 * margin * (up - first) / walls;
            for (const Vector2d& corner : lattice.corners(i, j + 4 * margin, angle)) middle += corner / walls;
            if (outline.contains(drawn.middle() + scale * (middle - down - at))) cells.push_back({i, j});
          }
        cells = from_zero(largest_piece(lattice, angle, cells));
        if (cells.size() >= least_cells && known.insert(cells).second) found.push_back(std::move(cells));
      }
  return found;
}

}  // namespace kinetix::optim
