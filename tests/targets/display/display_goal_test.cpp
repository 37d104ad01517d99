#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "targets/display/display_goal.hpp"
#include "targets/display/picture.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::targets {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal;

using Rows = std::vector<std::string>;

TEST(DisplayGoal, HasTheTopRowOfAPictureAtTheLargestJ) {
  const DisplayGoal goal = rows_goal({"100", "011"});
  EXPECT_EQ(goal.columns, 3);
  EXPECT_EQ(goal.rows, 2);
  EXPECT_THAT(goal.levels, ElementsAre(0, 1, 1, 1, 0, 0));
  EXPECT_EQ(goal.level(0, 1), 1);
  EXPECT_EQ(goal.level(0, 0), 0);
  EXPECT_TRUE(goal.is_letter(2, 0));
  EXPECT_TRUE(goal.is_binary());
  EXPECT_FALSE(goal.needed);
}

TEST(DisplayGoal, RandomRowsComeBackAsTheyWere) {
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    Rows rows(2 + random() % 7, std::string(2 + random() % 9, '0'));
    for (std::string& row : rows)
      for (char& c : row) c = random() % 2 ? '1' : '0';
    rows[0][0] = '0', rows[0][1] = '1';
    EXPECT_EQ(rows_goal(rows).row_texts(), rows);
  }
}

TEST(DisplayGoal, RowsAreRedrawnCellByCell) {
  const DisplayGoal goal = rows_goal({"011", "010"}), twice = goal.resized({6, 4});
  EXPECT_TRUE(twice.whole);
  EXPECT_FALSE(goal.resized({4, 3}).whole);
  EXPECT_EQ(twice.row_texts(), (std::vector<std::string>{"001111", "001111", "001100", "001100"}));
}

TEST(DisplayGoal, TellsGreyFromBinary) {
  const DisplayGoal goal = make_goal({2, 2}, {0, 0.25, 0.5, 1});
  EXPECT_FALSE(goal.is_binary());
  EXPECT_THAT(goal.row_texts(), ElementsAre("11", "00"));
  EXPECT_THAT(thresholded(goal.levels), ElementsAre(0, 0, 1, 1));
}

TEST(DisplayGoal, RefusesRowsThatAreNoPicture) {
  EXPECT_THAT(refusal([] { rows_goal({}); }), HasSubstr("has no rows"));
  EXPECT_THAT(refusal([] { rows_goal({"010", "01"}); }), HasSubstr("has 2 cells, and the first row has 3"));
  EXPECT_THAT(refusal([] { rows_goal({"01", "0x"}); }), HasSubstr("`0x` has characters other than 0 and 1"));
  EXPECT_THAT(refusal([] { rows_goal({"11", "11"}); }), HasSubstr("every cell is letter"));
  EXPECT_THAT(refusal([] { rows_goal({"00", "00"}); }), HasSubstr("every cell is rest"));
  EXPECT_THAT(refusal([] { rows_goal({"01"}); }), HasSubstr("2 x 1 cells is too small. Give at least 2 x 2"));
}

TEST(DisplayGoal, KeepsPanelsWithinBounds) {
  EXPECT_NO_THROW(check_panel({2, 2}));
  EXPECT_NO_THROW(check_panel({1000, 250}));
  EXPECT_THAT(refusal([] { check_panel({1, 10}); }), HasSubstr("1 x 10 cells is too small"));
  EXPECT_THAT(refusal([] { check_panel({-3, 10}); }), HasSubstr("too small"));
  EXPECT_THAT(refusal([] {
                check_panel({1001, 10});
              }),
              HasSubstr("too large. Give at most 1000 cells per side"));
  EXPECT_THAT(refusal([] { check_panel({501, 500}); }), HasSubstr("250000 in all"));
}

TEST(InkCoverage, IsExactForARectangleThatCutsPixelsAndCells) {
  // 6 x 4 pixels, ink in columns 1..4 of rows 1..2; cells of 1.5 x 2 pixels.
  const Picture picture{
      6, 4, {0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0, 0, 0, 0}};
  const double outer = 0.5 * 1 / 3, inner = 1.5 * 1 / 3;
  EXPECT_THAT(ink_coverage(picture, frame(picture), {4, 2}),
              ElementsAre(outer, inner, inner, outer, outer, inner, inner, outer));
  EXPECT_THAT(ink_coverage(picture, frame(picture), {2, 1}), ElementsAre(4.0 / 12, 4.0 / 12));
}

TEST(InkCoverage, CountsNoInkBeyondThePicture) {
  const Picture picture{1, 1, {255}};
  EXPECT_THAT(ink_coverage(picture, {-1, 2, -2, 1}, {3, 3}), ElementsAre(0, 1, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(ink_coverage(picture, {-0.5, 1.5, -0.5, 1.5}, {2, 2}), ElementsAre(0.25, 0.25, 0.25, 0.25));
}

TEST(InkCoverage, SumsToTheInkForRandomPicturesFinerOrCoarserThanThePanel) {
  std::mt19937 random(8);
  for (int round = 0; round < 200; ++round) {
    Picture picture{static_cast<int>(1 + random() % 30), static_cast<int>(1 + random() % 30), {}};
    picture.ink.resize(static_cast<std::size_t>(picture.width) * picture.height);
    double ink = 0, covered = 0;
    for (auto& pixel : picture.ink) ink += pixel = static_cast<std::uint8_t>(random() % 256);
    const PanelSize size = {static_cast<int>(1 + random() % 20), static_cast<int>(1 + random() % 20)};
    for (const double level : ink_coverage(picture, frame(picture), size)) covered += level;
    EXPECT_NEAR(covered / (size[0] * size[1]), ink / 255 / static_cast<double>(picture.ink.size()), 1e-12);
  }
}

TEST(Topology, CountsPartsOverCornersAndHolesOverEdges) {
  EXPECT_EQ(topology(rows_goal({"111", "101", "111"})), (Topology{1, 1}));
  EXPECT_EQ(topology(rows_goal({"010", "101", "010"})), (Topology{1, 1}));
  EXPECT_EQ(topology(rows_goal({"110", "101", "011"})), (Topology{1, 1}));
  EXPECT_EQ(topology(rows_goal({"101", "000", "101"})), (Topology{4, 0}));
  EXPECT_EQ(topology(rows_goal({"11111", "10101", "11111", "00000", "11111"})), (Topology{2, 2}));
  EXPECT_EQ(topology(rows_goal({"011", "101", "111"})), (Topology{1, 1}));
  EXPECT_EQ(topology(Picture{3, 1, {128, 127, 255}}), (Topology{2, 0}));
}

TEST(DisplayScore, MatchesNumbersWorkedOutByHand) {
  // Letter 3, 5 (mean 4, variance 1), rest 0, 2, 4 (mean 2, variance 8/3); of six pairs five are in order.
  const DisplayScore score = display_score({3, 5, 0, 2, 4}, {1, 1, 0, 0, 0});
  EXPECT_DOUBLE_EQ(score.letter, 4);
  EXPECT_DOUBLE_EQ(score.rest, 2);
  EXPECT_DOUBLE_EQ(score.contrast, 2 / std::sqrt((1 + 8.0 / 3) / 2));
  EXPECT_DOUBLE_EQ(score.auc, 5.0 / 6);
}

TEST(DisplayScore, CellsThatAreAllTheSameShowNothing) {
  const DisplayScore score = display_score({0.92, 0.92 + 1e-15, 0.92, 0.92 - 1e-15}, {1, 0, 1, 0});
  EXPECT_EQ(score.contrast, 0);
  EXPECT_EQ(score.auc, 0.5);
}

TEST(DisplayScore, TiesCountHalf) { EXPECT_DOUBLE_EQ(display_score({1, 1, 0}, {1, 0, 0}).auc, 0.75); }

// Regression: a score, such as that of 2 x 2 cells, was infinite, which JSON cannot hold.
TEST(DisplayScore, APictureWithoutScatterHasThatOfTheLeastOneThatCounts) {
  EXPECT_DOUBLE_EQ(display_score({1, 1, 0}, {1, 1, 0}).contrast, 1e5);
  EXPECT_DOUBLE_EQ(display_score({0, 0, 1}, {1, 1, 0}).contrast, -1e5);
}

TEST(DisplayScore, NanShows) {
  const DisplayScore score = display_score({1, NAN, 0}, {1, 1, 0});
  EXPECT_TRUE(std::isnan(score.contrast));
  EXPECT_TRUE(std::isnan(score.auc));
}

TEST(RankCorrelation, IsOneForAnyIncreasingFunctionAndHandlesTies) {
  EXPECT_NEAR(rank_correlation({0, 1, 8, 27}, {0, 0.1, 0.2, 0.3}), 1, 1e-15);
  EXPECT_NEAR(rank_correlation({27, 8, 1, 0}, {0, 0.1, 0.2, 0.3}), -1, 1e-15);
  // Ranks 1.5, 1.5, 3 and 1, 2, 3: covariance 1/2, variances 1/2 and 2/3.
  EXPECT_NEAR(rank_correlation({5, 5, 6}, {1, 2, 3}), 0.5 / std::sqrt(0.5 * 2 / 3), 1e-15);
  EXPECT_EQ(rank_correlation({1, 1, 1}, {1, 2, 3}), 0);
  // Light that is no number, as of walls without a thickness, ends in some rank.
  EXPECT_LE(std::abs(rank_correlation({NAN, 1, NAN}, {1, 2, 3})), 1 + 1e-15);
}

}  // namespace
}  // namespace kinetix::targets
