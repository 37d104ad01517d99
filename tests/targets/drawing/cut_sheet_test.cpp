#include "targets/drawing/cut_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/base/geometry.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/cut_squares.hpp"

namespace kinetix::targets {
namespace {

using testing::cut_squares;
using ::testing::HasSubstr;
using testing::refusal;

using Ends = std::vector<std::array<double, 4>>;

std::vector<DrawnLine> cut_lines(const Ends& ends, int colour = 0) {
  std::vector<DrawnLine> lines;
  for (const auto& [x0, y0, x1, y1] : ends)
    lines.push_back({.from = {x0, y0}, .to = {x1, y1}, .colour = colour});
  return lines;
}

/// Returns the outline of a sheet and lines within it.
std::vector<DrawnLine> within(double wide, double high, const Ends& ends) {
  std::vector<DrawnLine> lines =
      cut_lines({{0, 0, wide, 0}, {wide, 0, wide, high}, {wide, high, 0, high}, {0, high, 0, 0}});
  for (const DrawnLine& line : cut_lines(ends)) lines.push_back(line);
  return lines;
}

double area_of(const std::vector<model::FlatRing>& piece) {
  double area = 0;
  for (const model::FlatRing& ring : piece) area += signed_area(ring);
  return area;
}

TEST(CutSheet, TakesTurningSquaresApart) {
  const CutSheet sheet = make_cut_sheet(cut_squares(3, 20, 1.5), {});
  ASSERT_EQ(sheet.pieces.size(), 9U);
  ASSERT_EQ(sheet.joints.size(), 12U);
  EXPECT_TRUE(sheet.is_outlined);
  EXPECT_EQ(sheet.loose, 0);
  for (const SheetJoint& joint : sheet.joints) EXPECT_NEAR(joint.length(), 1.5, 1e-9);
  // Each bridge takes about half a circle of 1.06 mm from a piece, within 0.75 mm of its middle.
  for (int k = 0; k < 9; ++k) {
    const auto bridges =
        std::count_if(sheet.joints.begin(), sheet.joints.end(),
                      [&](const SheetJoint& joint) { return joint.lower == k || joint.upper == k; });
    const double lost = 19.8 * 19.8 - area_of(sheet.pieces[k]);
    EXPECT_GT(lost, 0.8 * static_cast<double>(bridges));
    EXPECT_LT(lost, 1.4 * static_cast<double>(bridges));
  }
  EXPECT_EQ(sheet.joints[0].lower, 0);  // pieces from below, and from the left
  EXPECT_EQ(sheet.joints[0].upper, 1);
  EXPECT_EQ(sheet.joints[1].upper, 3);
}

TEST(CutSheet, ReadsItsOwnLinesTheSame) {
  const CutSheet sheet = make_cut_sheet(cut_squares(4, 10, 1), {.kerf_mm = 0.1});
  const CutSheet again =
      make_cut_sheet(sheet.lines, {.kerf_mm = 0.1, .bridge_mm = sheet.bridge_mm, .join_mm = sheet.join_mm});
  ASSERT_EQ(again.joints.size(), sheet.joints.size());
  for (std::size_t k = 0; k < sheet.joints.size(); ++k) {
    EXPECT_EQ(again.joints[k].lower, sheet.joints[k].lower);
    EXPECT_EQ(again.joints[k].upper, sheet.joints[k].upper);
    EXPECT_NEAR((again.joints[k].from - sheet.joints[k].from).norm(), 0, 1e-9);
  }
}

TEST(CutSheet, DrawsARectangleAroundOpenCuts) {
  std::vector<DrawnLine> lines = cut_squares(2, 20, 1.5);
  lines.erase(lines.begin(), lines.begin() + 4);  // the outline
  lines.push_back({.from = {0, 0}, .to = {5, 0}});
  lines.push_back({.from = {40, 35}, .to = {40, 40}});
  const CutSheet sheet = make_cut_sheet(lines, {});
  EXPECT_FALSE(sheet.is_outlined);
  EXPECT_EQ(sheet.pieces.size(), 4U);
  EXPECT_EQ(sheet.joints.size(), 4U);
}

TEST(CutSheet, FindsBridgesOfALivingHinge) {
  // Two rows of slits, each row with a gap of 2 mm; rows are 3 mm apart.
  const CutSheet sheet = make_cut_sheet(
      within(24, 30, {{0, 13, 11, 13}, {13, 13, 24, 13}, {0, 16, 5, 16}, {7, 16, 24, 16}}), {});
  ASSERT_EQ(sheet.pieces.size(), 3U);
  ASSERT_EQ(sheet.joints.size(), 2U);
  for (const SheetJoint& joint : sheet.joints) EXPECT_NEAR(joint.length(), 2, 1e-9);
}

TEST(CutSheet, FindsBridgesBetweenSlotsAndCrossbars) {
  // Slots are closed lines, 1 mm wide, whose ends are 2 mm apart and 2 mm from the outline.
  Ends slots;
  for (const double x : {2.0, 14.0})
    slots.insert(slots.end(), {{x, 5, x + 10, 5}, {x + 10, 5, x + 10, 6}, {x + 10, 6, x, 6}, {x, 6, x, 5}});
  const CutSheet closed = make_cut_sheet(within(26, 11, slots), {});
  EXPECT_EQ(closed.pieces.size(), 2U);
  EXPECT_EQ(closed.joints.size(), 3U);
  // Crossbars at the ends of two cuts face each other.
  const CutSheet bars =
      make_cut_sheet(within(24, 20, {{0, 10, 11, 10}, {11, 9, 11, 11}, {13, 10, 24, 10}, {13, 9, 13, 11}}),
                     {.bridge_mm = 4});
  EXPECT_EQ(bars.pieces.size(), 2U);
  ASSERT_EQ(bars.joints.size(), 1U);
  EXPECT_NEAR(bars.joints[0].length(), 2, 1e-9);
}

/// The ends of slots are straight and wider than the gaps before them. Their bridges are in the middle.
TEST(CutSheet, FindsBridgesAtBluntEndsOfSlots) {
  const CutSheet closed = make_cut_sheet(
      within(40, 20,
             {{19, 1.25, 21, 1.25}, {21, 1.25, 21, 18.75}, {21, 18.75, 19, 18.75}, {19, 18.75, 19, 1.25}}),
      {});
  EXPECT_EQ(closed.pieces.size(), 2U);
  EXPECT_EQ(closed.loose, 1);
  ASSERT_EQ(closed.joints.size(), 2U);
  const CutSheet open_below = make_cut_sheet(
      within(40, 20, {{19, 0, 19, 18.75}, {19, 18.75, 21, 18.75}, {21, 18.75, 21, 0}}), {.bridge_mm = 5});
  ASSERT_EQ(open_below.joints.size(), 1U);
  for (const CutSheet* sheet : {&closed, &open_below})
    for (const SheetJoint& joint : sheet->joints) {
      EXPECT_NEAR(joint.length(), 1.25, 1e-9);
      EXPECT_NEAR(joint.from.x(), 20, 1e-9);
      EXPECT_NEAR(joint.to.x(), 20, 1e-9);
    }
}

TEST(CutSheet, JoinsAFlapAtTheOutline) {
  const CutSheet sheet = make_cut_sheet(
      within(40, 40, {{10, 10, 10, 30}, {10, 30, 30, 30}, {30, 30, 30, 10}}), {.bridge_mm = 25});
  ASSERT_EQ(sheet.pieces.size(), 2U);
  ASSERT_EQ(sheet.joints.size(), 2U);
}

TEST(CutSheet, SmallPieceRemainsWhereFourEndsMeet) {
  const CutSheet sheet = make_cut_sheet(
      within(40, 40, {{0, 20, 19, 20}, {21, 20, 40, 20}, {20, 0, 20, 19}, {20, 21, 20, 40}}), {});
  EXPECT_EQ(sheet.pieces.size(), 5U);
  EXPECT_EQ(sheet.joints.size(), 4U);
}

TEST(CutSheet, TakesCreasesByTheirColours) {
  std::vector<DrawnLine> lines = within(30, 20, {});
  for (const DrawnLine& line : cut_lines({{10, 0, 10, 8}, {10, 12, 10, 20}}, 0x00FF00)) lines.push_back(line);
  for (const DrawnLine& line : cut_lines({{10, 8, 10, 12}}, 0xFF0000)) lines.push_back(line);
  for (const DrawnLine& line : cut_lines({{0, 5, 10, 5}}, 0xFFFF00)) lines.push_back(line);  // no effect
  const CutSheet sheet = make_cut_sheet(lines, {});
  ASSERT_EQ(sheet.pieces.size(), 2U);
  ASSERT_EQ(sheet.joints.size(), 1U);
  EXPECT_TRUE(sheet.joints[0].is_crease);
  EXPECT_NEAR(sheet.joints[0].length(), 4, 1e-9);
}

TEST(CutSheet, LeavesOutWhatFallsOut) {
  std::vector<DrawnLine> lines = cut_squares(2, 20, 1.5);
  for (const DrawnLine& line : cut_lines({{5, 5, 10, 5}, {10, 5, 10, 10}, {10, 10, 5, 10}, {5, 10, 5, 5}}))
    lines.push_back(line);  // a window
  const CutSheet sheet = make_cut_sheet(lines, {.bridge_mm = 3});
  EXPECT_EQ(sheet.pieces.size(), 4U);
  EXPECT_EQ(sheet.loose, 1);
  EXPECT_EQ(sheet.pieces[0].size(), 2U);  // with a hole
}

std::string cut_refusal(const std::vector<DrawnLine>& lines, const CutSettings& settings = {}) {
  return refusal([&] { make_cut_sheet(lines, settings); });
}

TEST(CutSheet, RefusesSheetsThatDoNotComeApart) {
  EXPECT_THAT(cut_refusal({}), HasSubstr("no lines"));
  EXPECT_THAT(cut_refusal(within(20, 20, {})), HasSubstr("no cuts"));
  EXPECT_THAT(cut_refusal(within(20, 20, {{0, 10, 20, 10}})), HasSubstr("2 loose pieces"));
  EXPECT_THAT(cut_refusal(within(20, 20, {{5, 5, 9, 5}, {9, 5, 9, 9}, {9, 9, 5, 5}}), {.bridge_mm = 2}),
              HasSubstr("one piece, and 1 inside closed lines fall out"));
  // Two small pieces hang together inside a window, and the sheet around it is in one piece.
  EXPECT_THAT(
      cut_refusal(
          within(100, 100,
                 {{40, 40, 60, 40}, {60, 40, 60, 60}, {60, 60, 40, 60}, {40, 60, 40, 40}, {40, 50, 58, 50}}),
          {.bridge_mm = 3}),
      HasSubstr("the sheet stays in one piece"));
  EXPECT_THAT(cut_refusal(within(20, 20, {{0, 10, 10, 10}}), {.bridge_mm = 2}),
              HasSubstr("the next gap is 10 mm"));
  EXPECT_THAT(cut_refusal(within(20, 20, {{0, 10, 19.85, 10}})), HasSubstr("process.kerf_mm"));
  EXPECT_THAT(cut_refusal(within(30'000, 20, {{0, 10, 10, 10}})), HasSubstr("larger than 20 m"));
}

}  // namespace
}  // namespace kinetix::targets
