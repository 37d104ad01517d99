#include "app/structure_section.hpp"

#include <algorithm>
#include <map>

namespace kinetix {
namespace {

constexpr int max_side = 10'000;
constexpr std::size_t max_cells = 1'000'000;
constexpr const char* wanted_cells = "[columns, rows], or a list of cells [[i, j], ...]";

std::vector<Cell> read_rectangle(const Node& node, const std::vector<Node>& sides) {
  if (sides.size() != 2) throw node.error(std::string("is not a pair; give ") + wanted_cells);
  const int columns = sides[0].integer(1, max_side), rows = sides[1].integer(1, max_side);
  if (static_cast<std::size_t>(columns) * rows > max_cells)
    throw node.error("more than a million cells; give a smaller rectangle");
  return rectangle(columns, rows);
}

std::string name(const Cell& cell) {
  return "[" + std::to_string(cell.i) + ", " + std::to_string(cell.j) + "]";
}

}  // namespace

CellSize default_size(double edge_mm) {
  return {edge_mm, std::min(0.1 * edge_mm, 3.0), std::min(0.6 * edge_mm, 30.0)};
}

std::vector<Cell> read_cells(const Node& node) {
  const auto entries = node.list(wanted_cells);
  if (entries.empty()) throw node.error(std::string("is empty; give ") + wanted_cells);
  if (entries[0].kind() != Node::Kind::list) return read_rectangle(node, entries);
  std::map<Cell, int> line_of;
  std::vector<Cell> cells;
  for (const Node& entry : entries) {
    const auto ij = entry.list_of(2, "a cell [i, j]");
    cells.push_back({ij[0].integer(0, max_side - 1), ij[1].integer(0, max_side - 1)});
    const auto [first, is_new] = line_of.try_emplace(cells.back(), entry.place().line);
    if (!is_new)
      throw entry.error("cell " + name(cells.back()) + " is given twice, first in line " +
                        std::to_string(first->second) + "; give it once");
  }
  return cells;
}

std::optional<std::array<int, 2>> as_rectangle(const std::vector<Cell>& cells) {
  Cell low = cells[0], high = cells[0];
  for (const Cell& c : cells) {
    low = {std::min(low.i, c.i), std::min(low.j, c.j)};
    high = {std::max(high.i, c.i), std::max(high.j, c.j)};
  }
  const int columns = high.i - low.i + 1, rows = high.j - low.j + 1;
  if (static_cast<std::size_t>(columns) * rows != cells.size()) return std::nullopt;
  return std::array{columns, rows};
}

CellSize read_size(const std::optional<Node>& structure, double fallback_edge_mm) {
  CellSize size = default_size(fallback_edge_mm);
  if (!structure) return size;
  if (const auto edge = structure->optional("cell_mm"))
    size = default_size(edge->number(from_to(0.001, 10'000, "mm")));
  const auto wall = structure->optional("wall_mm");
  if (!wall) return size;
  wall->reject_unknown_keys({"thickness", "height"});
  if (const auto thickness = wall->optional("thickness"))
    size.thickness_mm = thickness->number(between(0, size.edge_mm / 2, "mm (less than half of cell_mm)"));
  if (const auto height = wall->optional("height"))
    size.height_mm = height->number({0, 10'000, false, true, "mm"});
  return size;
}

}  // namespace kinetix
