#include "model/lattice/square/changed_cells.hpp"

#include "model/lattice/square/crease.hpp"

namespace kinetix::model {
namespace {

/// Returns the hinge of a wall, or else one of the same crease.
std::optional<int> like(const Structure& structure, const Wall& wall) {
  if (const auto same = structure.hinge_at(wall)) return same;
  const auto [columns, rows] = extent(structure);
  Wall other = wall;
  int& line = wall.axis == Axis::x ? other.from.j : other.from.i;
  const int last = wall.axis == Axis::x ? rows : columns;
  for (line = 0; line <= last; ++line)
    if (const auto found = structure.hinge_at(other)) return found;
  return std::nullopt;
}

}  // namespace

HingeParameters carried_to(const Wall& wall, const Hinge& hinge) {
  HingeParameters out = hinge.parameters;
  if (alternation(wall) == alternation(hinge.wall)) return out;
  out.t = 1 - out.t;
  out.alpha = pi - out.alpha;
  out.beta = -out.beta;
  return out;
}

ChangedCells with_changed_cells(const Structure& before, std::vector<Cell> cells, const CellSize& size) {
  ChangedCells out{make_structure(std::move(cells), size), {}};
  for (Hinge& hinge : out.structure.hinges) {
    out.from.push_back(like(before, hinge.wall));
    if (const auto old = out.from.back()) hinge.parameters = carried_to(hinge.wall, before.hinges[*old]);
  }
  return out;
}

std::array<int, 2> extent(const Structure& structure) {
  std::array<int, 2> most = {0, 0};
  for (const Cell& cell : structure.cells)
    most = {std::max(most[0], cell.i + 1), std::max(most[1], cell.j + 1)};
  return most;
}

std::vector<Cell> with_cell(const Structure& structure, Cell cell, bool present) {
  std::vector<Cell> cells = structure.cells;
  std::erase(cells, cell);
  if (present) cells.push_back(cell);
  return cells;
}

std::vector<Cell> full_sheet(std::array<int, 2> extent) { return rectangle(extent[0], extent[1]); }

}  // namespace kinetix::model
