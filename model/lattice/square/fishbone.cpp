#include "model/lattice/square/fishbone.hpp"

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
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

FishbonePlace place_of(const Fishbone& fishbone, int body) {
  const Vertex v = fishbone.structure.bodies[body];
  const int left = fishbone.spine_column - v.i, right = v.i - fishbone.spine_column - 1;
  if (left <= 0 && right <= 0) return {};
  const std::vector<FishboneRib>& ribs = fishbone.layout.ribs;
  for (std::size_t r = 0; r < ribs.size(); ++r)
    if (v.j == ribs[r].row || v.j == ribs[r].row + 1)
      return {static_cast<int>(r), left > 0 ? 0 : 1, std::max(left, right)};
  return {};
}

std::vector<std::array<int, 2>> rib_columns(const Fishbone& fishbone, const FishboneRib& rib) {
  std::vector<std::array<int, 2>> columns;
  const int spine = fishbone.spine_column;
  for (int i = spine - rib.cells[0]; i <= spine + 1 + rib.cells[1]; ++i)
    columns.push_back(
        {*fishbone.structure.body_at({i, rib.row}), *fishbone.structure.body_at({i, rib.row + 1})});
  return columns;
}

std::array<std::array<int, 2>, 2> spine_ends(const Fishbone& fishbone) {
  const int i = fishbone.spine_column, top = fishbone.layout.rows;
  const auto body = [&](int column, int row) { return *fishbone.structure.body_at({column, row}); };
  return {std::array{body(i, 0), body(i + 1, 0)}, std::array{body(i, top), body(i + 1, top)}};
}

}  // namespace kinetix::model
