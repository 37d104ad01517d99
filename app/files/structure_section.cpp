#include "app/files/structure_section.hpp"

#include <cmath>
#include <map>

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int max_side = 10'000;              // cells: the longest strip that is read
constexpr std::size_t max_cells = 1'000'000;  // in all: rejected before bodies and hinges use memory
// Cell edges: thinner walls lose light and contact to rounding.
constexpr double min_thickness = 1e-6;
constexpr double min_height_mm = 1e-4;  // mm: below the default of the smallest cells, 0.0006 mm
constexpr double thin_thickness = 0.08, thin_height = 0.15;  // ratio to an edge
// Description of `cells` in messages.
constexpr const char* wanted_cells = "[columns, rows], or a list of cells [[i, j], ...]";

std::vector<model::Cell> read_rectangle(const targets::Node& node, const std::vector<targets::Node>& sides) {
  if (sides.size() != 2) throw node.error(std::string("is not a pair. Give ") + wanted_cells);
  const int columns = sides[0].integer(1, max_side), rows = sides[1].integer(1, max_side);
  if (static_cast<std::size_t>(columns) * rows > max_cells)
    throw node.error("there are more than a million cells. Give a smaller rectangle");
  return model::rectangle(columns, rows);
}

std::string name(const model::Cell& cell) {
  return "[" + std::to_string(cell.i) + ", " + std::to_string(cell.j) + "]";
}

targets::KeyTable wall_mm_keys(const char* thickness, const char* height) {
  return targets::KeyTable({
      {"thickness", value::length({min_thickness, 0.5, true, false, "mm (less than half of cell_mm)"}),
       targets::otherwise(thickness), "thickness of the walls"},
      {"height", value::number(targets::from_to(min_height_mm, 10'000, "mm")), targets::otherwise(height),
       "height of the walls"},
  });
}

}  // namespace

targets::Key cells_key(targets::Default fallback, std::string meaning) {
  const auto side = value::integer(1, max_side), index = value::integer(0, max_side - 1);
  return {
      "cells",
      value::either({value::list(side, "`[columns, rows]`", 2, 2),
                     value::list(value::list(index, "`[i, j]`", 2, 2), "a list of cells `[[i, j], ...]`")}),
      std::move(fallback), std::move(meaning)};
}

targets::Key cell_mm_key(targets::Default fallback, const targets::Bounds& bounds) {
  return {"cell_mm", value::number(bounds), std::move(fallback), "cell edge"};
}

targets::Key wall_mm_key(const char* thickness, const char* height) {
  return {"wall_mm", wall_mm_keys(thickness, height), "size of the walls"};
}

targets::Key thin_walls_key(const std::string& edge, std::string meaning) {
  const auto key = [&](const char* name, std::optional<double> ThinWalls::*member, double part) {
    return targets::Key(name, member, value::number(targets::above(0, "mm")),
                        targets::otherwise(targets::shortest_text(part) + " " + edge), "size of the walls");
  };
  return {"wall_mm",
          targets::KeyTable({key("thickness", &ThinWalls::thickness_mm, thin_thickness),
                             key("height", &ThinWalls::height_mm, thin_height)}),
          std::move(meaning)};
}

model::CellSize default_size(double edge_mm) {
  return {edge_mm, std::min(0.1 * edge_mm, 3.0), std::min(0.6 * edge_mm, 30.0)};
}

model::CellSize ThinWalls::size(double edge_mm) const {
  return {edge_mm, thickness_mm.value_or(thin_thickness * edge_mm),
          height_mm.value_or(thin_height * edge_mm)};
}

std::vector<model::Cell> read_cells(const targets::Node& node) {
  const auto entries = node.list(wanted_cells);
  if (entries.empty()) throw node.error(std::string("the list is empty. Give ") + wanted_cells);
  if (entries[0].kind() != targets::Node::Kind::list) return read_rectangle(node, entries);
  std::map<model::Cell, int> line_of;
  std::vector<model::Cell> cells;
  for (const targets::Node& entry : entries) {
    const auto ij = entry.list_of(2, "a cell [i, j]");
    cells.push_back({ij[0].integer(0, max_side - 1), ij[1].integer(0, max_side - 1)});
    const auto [first, is_new] = line_of.try_emplace(cells.back(), entry.place().line);
    if (!is_new)
      throw entry.error("cell " + name(cells.back()) + " is listed twice, first in line " +
                        std::to_string(first->second) + ". Remove one of the two entries");
  }
  return cells;
}

std::optional<std::array<int, 2>> as_rectangle(const std::vector<model::Cell>& cells) {
  model::Cell low = cells[0], high = cells[0];
  for (const model::Cell& c : cells) {
    low = {std::min(low.i, c.i), std::min(low.j, c.j)};
    high = {std::max(high.i, c.i), std::max(high.j, c.j)};
  }
  const int columns = high.i - low.i + 1, rows = high.j - low.j + 1;
  if (static_cast<std::size_t>(columns) * rows != cells.size()) return std::nullopt;
  return std::array{columns, rows};
}

model::CellSize read_size(const targets::Section& structure, double fallback_edge_mm) {
  double edge_mm = fallback_edge_mm;
  structure.read("cell_mm", edge_mm);
  model::CellSize size = default_size(edge_mm);
  const targets::Section wall = structure.section("wall_mm");
  wall.read_length("thickness", size.thickness_mm, edge_mm);
  wall.read("height", size.height_mm);
  return size;
}

double mm_of(double cells, double edge_mm) {
  const double mm = cells * edge_mm;
  for (const double near : {mm, std::nextafter(mm, 0), std::nextafter(mm, 2 * mm)})
    if (near / edge_mm == cells) return near;
  return mm;
}

}  // namespace kinetix::app
