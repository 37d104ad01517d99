#include "model/lattice/square/cell_rectangle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace kinetix::model {
namespace {

constexpr Side all_sides[] = {Side::left, Side::right, Side::bottom, Side::top};
constexpr Axis axes[] = {Axis::x, Axis::y};

/// All rectangles of up to 3 x 3 cells near the origin, on both sides of it.
std::vector<CellRectangle> small_rectangles() {
  std::vector<CellRectangle> all;
  for (const Cell& low : CellRectangle{{-2, -2}, 4, 4}.cells())
    for (int width = 1; width <= 3; ++width)
      for (int height = 1; height <= 3; ++height) all.push_back({low, width, height});
  return all;
}

std::set<Cell> cells_of(const CellRectangle& r) {
  std::set<Cell> cells;
  for (int i = r.low.i; i < r.low.i + r.width; ++i)
    for (int j = r.low.j; j < r.low.j + r.height; ++j) cells.insert({i, j});
  return cells;
}

std::set<Vertex> vertices_of(const std::set<Cell>& cells) {
  std::set<Vertex> vertices;
  for (const Cell& c : cells)
    vertices.insert({{c.i, c.j}, {c.i + 1, c.j}, {c.i, c.j + 1}, {c.i + 1, c.j + 1}});
  return vertices;
}

/// The next cell or vertex along an axis.
template <class Place>
Place stepped(Place place, Axis axis, int steps) {
  (axis == Axis::x ? place.i : place.j) += steps;
  return place;
}

template <class Place>
std::set<Place> set_of(const std::vector<Place>& places) {
  const std::set<Place> set(places.begin(), places.end());
  EXPECT_EQ(set.size(), places.size()) << "one is listed twice";
  return set;
}

/// Returns the images of a rectangle's cells under a motion.
template <class Motion>
std::set<Cell> images(const CellRectangle& r, const Motion& motion) {
  std::set<Cell> out;
  for (const Cell& c : cells_of(r)) out.insert(motion(c));
  return out;
}

TEST(Side, HasItsOppositeAcrossTheSameAxis) {
  for (const Side side : all_sides) {
    EXPECT_NE(opposite(side), side);
    EXPECT_EQ(opposite(opposite(side)), side);
    EXPECT_EQ(across(opposite(side)), across(side));
    EXPECT_NE(is_upper(opposite(side)), is_upper(side));
  }
}

TEST(CellRectangle, ListsItsCellsAndVerticesSorted) {
  for (const CellRectangle& r : small_rectangles()) {
    EXPECT_EQ(set_of(r.cells()), cells_of(r));
    EXPECT_EQ(set_of(r.vertices()), vertices_of(cells_of(r)));
    EXPECT_TRUE(std::ranges::is_sorted(r.cells()));
    EXPECT_TRUE(std::ranges::is_sorted(r.vertices()));
  }
}

TEST(CellRectangle, ListsItsVerticesRowByRow) {
  for (const CellRectangle& r : small_rectangles()) {
    const std::vector<Vertex> rows = r.rows_of_vertices();
    EXPECT_EQ(set_of(rows), set_of(r.vertices()));
    EXPECT_TRUE(
        std::ranges::is_sorted(rows, [](Vertex a, Vertex b) { return a.j != b.j ? a.j < b.j : a.i < b.i; }));
  }
}

/// Checks gaps cell by cell. A cell of a gap is outside both rectangles. On one hand along the axis cells of one
/// follow, on the other hand cells of the other. @param every nth of the small rectangles
void expect_gaps(std::size_t every) {
  const CellRectangle room{{-12, -12}, 24, 24}, fixed{{-1, 1}, 3, 2};
  const auto has_beyond = [](const std::set<Cell>& cells, const Cell& c, Axis axis, int step) {
    for (int k = 1; k < 20; ++k)
      if (cells.contains(stepped(c, axis, k * step))) return true;
    return false;
  };
  const std::vector<CellRectangle> all = small_rectangles();
  for (std::size_t k = 0; k < all.size(); k += every)
    for (const Side side : all_sides)
      for (const int gap : {1, 2, 4})
        for (int shift = -4; shift <= 4; ++shift) {
          const CellRectangle placed = all[k].beside(fixed, side, gap, shift);
          const auto near = cells_of(fixed), far = cells_of(placed);
          const int step = is_upper(side) ? 1 : -1;
          std::set<Cell> between;
          for (const Cell& c : cells_of(room))
            if (!near.contains(c) && !far.contains(c) && has_beyond(near, c, across(side), -step) &&
                has_beyond(far, c, across(side), step))
              between.insert(c);
          const CellRectangle found = gap_between(fixed, side, placed);
          EXPECT_EQ(found.is_empty(), between.empty());
          if (!found.is_empty()) {
            EXPECT_EQ(cells_of(found), between);
            EXPECT_EQ(found.extent(across(side)), gap);
          }
          const Axis along = across(side) == Axis::x ? Axis::y : Axis::x;
          EXPECT_EQ(row_along(along, placed.corner(side)), row_along(along, fixed.corner(side)) + shift);
          EXPECT_EQ(fixed.beside(placed, opposite(side), gap, -shift), fixed);
        }
}

/// Every seventh rectangle has every size and most of the places.
TEST(CellRectangle, LiesBesideAnotherOneWithTheCellsOfTheGapBetweenThem) { expect_gaps(7); }

TEST(CellRectangleSoak, LiesBesideAnotherOneWithTheCellsOfTheGapBetweenThem) { expect_gaps(1); }

TEST(CellRectangle, MovesTurnsAndMirrorsAsEachOfItsCellsDoes) {
  for (const CellRectangle& r : small_rectangles()) {
    EXPECT_EQ(cells_of(r.seen_from({-3, 2})), images(r, [](Cell c) { return Cell{c.i + 3, c.j - 2}; }));
    // The middle of cell (i, j) is at (i + 1/2, j + 1/2).
    EXPECT_EQ(cells_of(r.turned()), images(r, [](Cell c) { return Cell{-c.j - 1, c.i}; }));
    EXPECT_EQ(cells_of(r.mirrored()), images(r, [](Cell c) { return Cell{-c.i - 1, c.j}; }));
    EXPECT_EQ(r.turned().turned().turned().turned(), r);
    EXPECT_EQ(r.mirrored().mirrored(), r);
  }
}

TEST(CellRectangle, TouchesThoseThatHaveAVertexOfIts) {
  const std::vector<CellRectangle> all = small_rectangles();
  for (const CellRectangle& a : {all.front(), all[40], all.back(), CellRectangle{{3, -3}, 1, 2}})
    for (const CellRectangle& b : all) {
      const auto of_a = vertices_of(cells_of(a)), of_b = vertices_of(cells_of(b));
      const bool common = std::ranges::any_of(of_a, [&](Vertex v) { return of_b.contains(v); });
      EXPECT_EQ(touch(a, b), common);
      EXPECT_EQ(touch(b, a), common);
    }
}

TEST(CellRectangle, HasTheWallsOfItsCellsThatPointAlongAnAxis) {
  for (const CellRectangle& r : small_rectangles())
    for (const Axis axis : axes) {
      const Axis aside = axis == Axis::x ? Axis::y : Axis::x;
      std::set<Wall> walls;
      for (const Cell& c : cells_of(r)) {
        walls.insert({{c.i, c.j}, axis});
        walls.insert({stepped(Vertex{c.i, c.j}, aside, 1), axis});
      }
      EXPECT_EQ(set_of(r.walls_along(axis)), walls);
    }
}

TEST(CellRectangle, HasTheVerticesBetweenItsEndsLineByLine) {
  for (const CellRectangle& r : small_rectangles())
    for (const Axis axis : axes) {
      const auto all = vertices_of(cells_of(r));
      std::set<Vertex> between;
      for (const Vertex& v : all)
        if (all.contains(stepped(v, axis, 1)) && all.contains(stepped(v, axis, -1))) between.insert(v);
      const std::vector<Vertex> found = r.vertices_between_ends(axis);
      EXPECT_EQ(set_of(found), between);
      EXPECT_TRUE(std::ranges::is_sorted(found, {}, [&](const Vertex& v) { return row_along(axis, v); }));
    }
}

TEST(CellRectangle, HasACornerOnEachSideAndItsMiddleBetweenThem) {
  for (const CellRectangle& r : small_rectangles()) {
    const auto all = vertices_of(cells_of(r));
    for (const Side side : all_sides) {
      const auto beyond = [&](const Vertex& v) {
        return (is_upper(side) ? 1 : -1) * row_along(across(side), v);
      };
      std::vector<Vertex> on_side;
      for (const Vertex& v : all)
        if (std::ranges::all_of(all, [&](const Vertex& w) { return beyond(w) <= beyond(v); }))
          on_side.push_back(v);
      EXPECT_EQ(r.corner(side), *std::ranges::min_element(on_side));
    }
    const auto from_middle = [&](const Vertex& v) {
      return std::hypot(v.i - r.low.i - r.width / 2.0, v.j - r.low.j - r.height / 2.0);
    };
    EXPECT_EQ(r.middle(), *std::ranges::min_element(all, {}, from_middle));
  }
}

TEST(CellRectangle, BoundsHoldAllCellsAndEachSideHasOne) {
  const std::vector<CellRectangle> all = small_rectangles();
  for (std::size_t k = 0; k + 50 < all.size(); k += 7) {
    const std::vector<CellRectangle> some = {all[k], all[k + 50], all[k + 13]};
    int low_i = 100, high_i = -100, low_j = 100, high_j = -100;
    for (const CellRectangle& r : some)
      for (const Cell& c : cells_of(r)) {
        low_i = std::min(low_i, c.i), high_i = std::max(high_i, c.i);
        low_j = std::min(low_j, c.j), high_j = std::max(high_j, c.j);
      }
    EXPECT_EQ(bounds(some), (CellRectangle{{low_i, low_j}, high_i - low_i + 1, high_j - low_j + 1}));
  }
}

TEST(CellRectangle, NamesTheBodiesOfASheetRowByRow) {
  const Structure sheet = make_sheet(6, 5, {});
  const CellRectangle r{{2, 1}, 3, 2};
  const std::vector<int> bodies = bodies_of(r, sheet);
  ASSERT_EQ(bodies.size(), 12u);
  for (int j = 0; j <= 2; ++j)
    for (int i = 0; i <= 3; ++i) EXPECT_EQ(sheet.bodies[bodies[j * 4 + i]], (Vertex{2 + i, 1 + j}));
  EXPECT_EQ(sheet.bodies[middle_body(r, sheet)], (Vertex{3, 2}));
}

}  // namespace
}  // namespace kinetix::model
