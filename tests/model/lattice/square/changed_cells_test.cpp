#include <gtest/gtest.h>

#include "model/lattice/square/changed_cells.hpp"
#include "model/lattice/square/crease.hpp"
#include "model/lattice/square/family/classification.hpp"

namespace kinetix::model {
namespace {

Structure bent(int columns, int rows) {
  Structure out = make_structure(rectangle(columns, rows), CellSize{});
  for (const Crease& crease : find_creases(out).list)
    if (crease.axis == Axis::x) set_tilt(out, crease, 0.1 * (1 + line_of(out, crease)));
  return out;
}

void expect_same(const HingeParameters& a, const HingeParameters& b) {
  EXPECT_DOUBLE_EQ(a.t, b.t);
  EXPECT_DOUBLE_EQ(a.alpha, b.alpha);
  EXPECT_DOUBLE_EQ(a.beta, b.beta);
  EXPECT_DOUBLE_EQ(a.offset, b.offset);
}

TEST(ChangedCells, WallsThatStayKeepTheirHinges) {
  const Structure before = bent(4, 3);
  const ChangedCells after = with_changed_cells(before, with_cell(before, {0, 0}, false), before.size);
  ASSERT_EQ(after.structure.cells.size(), 11u);
  for (std::size_t h = 0; h < after.from.size(); ++h) {
    const Hinge& hinge = after.structure.hinges[h];
    ASSERT_EQ(after.from[h], before.hinge_at(hinge.wall));
    expect_same(hinge.parameters, before.hinges[*after.from[h]].parameters);
  }
}

TEST(ChangedCells, ASheetThatGrowsAlongItsCreasesIsTheSameDesignDrawnAtOnce) {
  const Structure after = with_changed_cells(bent(4, 2), full_sheet({4, 5}), CellSize{}).structure,
                  whole = bent(4, 5);
  ASSERT_EQ(after.hinges.size(), whole.hinges.size());
  for (std::size_t h = 0; h < whole.hinges.size(); ++h)
    expect_same(after.hinges[h].parameters, whole.hinges[h].parameters);
  EXPECT_EQ(extent(after), (std::array{4, 5}));
}

TEST(ChangedCells, CarriedThereAndBackIsTheSame) {
  Structure sheet = bent(3, 3);
  for (const Crease& crease : find_creases(sheet).list) {
    Hinge first = sheet.hinges[crease.hinges.front()];
    first.parameters.t = 0.3;
    first.parameters.alpha = 1.2;
    for (const int h : crease.hinges) {
      Hinge there = sheet.hinges[h];
      there.parameters = carried_to(there.wall, first);
      expect_same(carried_to(first.wall, there), first.parameters);
    }
  }
}

}  // namespace
}  // namespace kinetix::model
