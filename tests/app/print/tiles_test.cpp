#include "app/print/sheet/print_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kinetix::app {
namespace {

using ::testing::HasSubstr;
using Boxes = std::vector<Eigen::AlignedBox2d>;

/// Returns boxes of crosses in a sheet of 30 mm cells: 34 mm wide inside, 17 mm wide at the boundary.
Boxes panel_boxes(int columns, int rows) {
  Boxes all;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d at(30 * column, 30 * row);
      const Eigen::Vector2d low(column == 0 ? -2 : -17, row == 0 ? -2 : -17),
          high(column == columns - 1 ? 2 : 17, row == rows - 1 ? 2 : 17);
      all.emplace_back(at + low, at + high);
    }
  return all;
}

/// Checks that each tile has bodies, that each body belongs to a tile, and that each tile fits on the bed.
void expect_sound(const Tiles& tiles, const Boxes& boxes, const Eigen::Vector2d& bed_mm) {
  ASSERT_EQ(tiles.of_body.size(), boxes.size());
  std::vector<Eigen::AlignedBox2d> whole(tiles.count());
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (!boxes[b].isEmpty()) whole.at(tiles.of_body[b]).extend(boxes[b]);
  for (const Eigen::AlignedBox2d& tile : whole) {
    ASSERT_FALSE(tile.isEmpty());
    const Eigen::Vector2d size = tile.sizes(), bed = tiles.turned ? bed_mm.reverse() : bed_mm;
    EXPECT_LE(size.x(), bed.x() + 1e-3);
    EXPECT_LE(size.y(), bed.y() + 1e-3);
  }
  EXPECT_LE(tiles.count(), tiles.columns * tiles.rows);
}

TEST(Tiles, AreOneWhereTheBedHoldsTheWhole) {
  const Boxes boxes = panel_boxes(4, 3);  // 94 x 64 mm
  for (const Eigen::Vector2d& bed : {Eigen::Vector2d(94, 64), {100, 80}, {64, 94}}) {
    const Tiles tiles = cut_into_tiles(boxes, bed);
    EXPECT_EQ(tiles.count(), 1);
    EXPECT_EQ(tiles.turned, bed.x() < bed.y());
    expect_sound(tiles, boxes, bed);
  }
}

TEST(Tiles, AreAsFewAsTheBedAllowsAndAboutEquallyWide) {
  const Boxes boxes = panel_boxes(4, 3);
  const Tiles halves = cut_into_tiles(boxes, {93, 70});
  EXPECT_EQ(halves.columns, 2);
  EXPECT_EQ(halves.rows, 1);
  EXPECT_EQ(halves.of_body, (std::vector<int>{0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1})) << "not three and one";
  const Tiles rows = cut_into_tiles(boxes, {300, 50});
  EXPECT_EQ(rows.columns * rows.rows, 2) << "a long bed that is lower than the sheet";
  const Tiles single = cut_into_tiles(boxes, {34, 34});
  EXPECT_EQ(single.count(), 12) << "a body each";
}

TEST(Tiles, AreNeverEmptyOfSheetsOfAnySize) {
  for (int columns = 1; columns <= 12; ++columns)
    for (const int rows : {1, 2, 7})
      for (double side = 34; side < 400; side += 23) {
        const Boxes boxes = panel_boxes(columns, rows);
        for (const Eigen::Vector2d& bed : {Eigen::Vector2d(side, side), {side, 34}, {40, side}})
          expect_sound(cut_into_tiles(boxes, bed), boxes, bed);
      }
}

/// A sheet in the shape of an L. One of the four places of its grid has no body and is not a tile.
TEST(Tiles, AreOnlyWhereThereAreBodies) {
  Boxes boxes = panel_boxes(4, 4);
  for (const int gone : {10, 11, 14, 15}) boxes[gone].setEmpty();
  const Tiles tiles = cut_into_tiles(boxes, {50, 50});
  EXPECT_EQ(tiles.columns, 2);
  EXPECT_EQ(tiles.rows, 2);
  EXPECT_EQ(tiles.count(), 3);
  expect_sound(tiles, boxes, {50, 50});
}

TEST(Tiles, AreRefusedOnlyWhereTheBedDoesNotHoldABody) {
  const Boxes boxes = panel_boxes(4, 3);
  EXPECT_NO_THROW(cut_into_tiles(boxes, {34, 300}));
  try {
    cut_into_tiles(boxes, {33, 300});
    FAIL();
  } catch (const BedTooSmall& e) {
    EXPECT_THAT(e.what(), HasSubstr("a bed of 33 x 300 mm does not hold a body of 34.0 x 34.0 mm"));
    EXPECT_THAT(e.what(), HasSubstr("smaller cells"));
  }
}

}  // namespace
}  // namespace kinetix::app
