#include "model/fishbone.hpp"

#include <algorithm>

#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

void validate(const FishboneLayout& layout) {
  if (layout.rows < 1) throw InvalidInput("a fishbone needs at least one row of cells");
  int last = -2;
  for (const FishboneRib& rib : layout.ribs) {
    if (rib.row < 0 || rib.row >= layout.rows || rib.cells[0] < 0 || rib.cells[1] < 0)
      throw InvalidInput("a rib lies outside of its fishbone");
    if (rib.row < last + 2)
      throw InvalidInput("the ribs of rows " + std::to_string(last) + " and " + std::to_string(rib.row) +
                         " overlap flat: leave at least one row of cells between two ribs");
    last = rib.row;
  }
}

int columns_below(const FishboneLayout& layout) {
  int most = 0;
  for (const FishboneRib& rib : layout.ribs) most = std::max(most, rib.cells[0]);
  return most;
}

std::vector<Cell> cells_of(const FishboneLayout& layout, int spine) {
  std::vector<Cell> cells;
  for (int j = 0; j < layout.rows; ++j) cells.push_back({spine, j});
  for (const FishboneRib& rib : layout.ribs) {
    for (int k = 1; k <= rib.cells[0]; ++k) cells.push_back({spine - k, rib.row});
    for (int k = 1; k <= rib.cells[1]; ++k) cells.push_back({spine + k, rib.row});
  }
  return cells;
}

}  // namespace

Fishbone make_fishbone(const FishboneLayout& layout, const CellSize& size) {
  validate(layout);
  Fishbone out;
  out.layout = layout;
  out.spine_column = columns_below(layout);
  out.structure = make_structure(cells_of(layout, out.spine_column), size);
  const Creases creases = find_creases(out.structure);
  const auto crease = [&](const Wall& wall) {
    return creases.list[creases.of_hinge[*out.structure.hinge_at(wall)]];
  };
  std::vector<bool> carries(layout.rows, false);
  for (const FishboneRib& rib : layout.ribs) {
    carries[rib.row] = true;
    auto& sides = out.ribs.emplace_back();
    for (int k = 1; k <= rib.cells[0]; ++k)
      sides[0].push_back(crease({{out.spine_column - k, rib.row}, Axis::x}));
    for (int k = 1; k <= rib.cells[1]; ++k)
      sides[1].push_back(crease({{out.spine_column + k, rib.row}, Axis::x}));
  }
  for (int j = 0; j < layout.rows; ++j)
    if (!carries[j]) out.spine.push_back(crease({{out.spine_column, j}, Axis::y}));
  out.middle = *out.structure.body_at({out.spine_column, layout.rows / 2});
  return out;
}

}  // namespace kinetix
