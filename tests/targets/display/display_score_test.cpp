#include "targets/display/display_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kinetix::targets {
namespace {

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
