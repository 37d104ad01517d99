#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"
#include "optim/doe/analysis.hpp"
#include "tests/optim/doe/test_functions.hpp"

namespace kinetix::optim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(MainEffects, OfATwoByTwoTableAreThoseByHand) {
  const Eigen::MatrixXd samples{{1, 5}, {1, 6}, {2, 5}, {2, 6}};
  const auto effects = main_effects(samples, std::vector<double>{1, 3, 10, 20});
  ASSERT_EQ(effects[0].levels.size(), 2u);
  const EffectLevel& low = effects[0].levels[0];
  EXPECT_EQ(low.lower, 1);
  EXPECT_EQ(low.upper, 1);
  EXPECT_DOUBLE_EQ(low.mean, 2);
  EXPECT_DOUBLE_EQ(low.standard_error, 1);
  EXPECT_EQ(low.used, 2);
  EXPECT_DOUBLE_EQ(effects[0].levels[1].mean, 15);
  EXPECT_DOUBLE_EQ(effects[0].levels[1].standard_error, 5);
  // Between 169, within 52 with two degrees of freedom.
  EXPECT_DOUBLE_EQ(effects[0].variance_share, (169 - 26.0) / 221);
  EXPECT_DOUBLE_EQ(effects[1].levels[0].mean, 5.5);
  EXPECT_FALSE(effects[0].binned);
}

/// In a grid, the means of one factor's levels contain nothing of the other factor. Shares of a sum are those of its
/// terms, however few the levels.
TEST(MainEffects, SharesOfAGridAreExact) {
  const Eigen::MatrixXd samples{{1, 5}, {1, 6}, {2, 5}, {2, 6}};
  const std::vector<double> sum = {6, 7, 7, 8}, first = {1, 1, 2, 2};
  for (const MainEffect& effect : main_effects(samples, sum, {.rows = TableRows::grid})) {
    EXPECT_DOUBLE_EQ(effect.variance_share, 0.5);
    EXPECT_TRUE(std::isnan(effect.share_lower));
  }
  const auto alone = main_effects(samples, first, {.rows = TableRows::grid});
  EXPECT_DOUBLE_EQ(alone[0].variance_share, 1);
  EXPECT_DOUBLE_EQ(alone[1].variance_share, 0);
}

TEST(MainEffects, SharesOfAGridOfManyLevelsLackNothingWithinTheirBins) {
  Eigen::MatrixXd samples(40, 2);
  std::vector<double> saw;
  for (int row = 0; row < 40; ++row) {
    samples.row(row) << row / 2, row % 2;
    saw.push_back(row / 2 % 2);
  }
  const auto effects = main_effects(samples, saw, {.rows = TableRows::grid});
  EXPECT_TRUE(effects[0].binned);
  EXPECT_EQ(effects[0].levels.size(), 10u);
  EXPECT_DOUBLE_EQ(effects[0].variance_share, 1) << "two levels in each bin, which the response tells apart";
  EXPECT_NEAR(effects[1].variance_share, 0, 1e-12);
}

TEST(MainEffects, TheIntervalHoldsTheShareInMostTables) {
  const std::vector<Factor> factors = {{"a", UniformRange{0, 1}}, {"b", UniformRange{0, 1}}};
  for (const double share : {0.1, 0.5, 0.9}) {
    int held = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const SamplePlan plan(factors,
                            {.method = SamplingMethod::monte_carlo, .samples = 40, .seed = seed, .base = {}});
      const auto f = [&](const std::vector<double>& x) {
        return std::sqrt(share) * x[0] + std::sqrt(1 - share) * x[1];
      };
      const MainEffect effect = main_effects(testing::table(plan), testing::responses(plan, f))[0];
      EXPECT_GE(effect.share_lower, 0);
      EXPECT_LE(effect.share_upper, 1);
      held += effect.share_lower <= share && share <= effect.share_upper;
    }
    EXPECT_GE(held, 180) << share;
  }
}

TEST(MainEffects, RelatedRowsHaveNoErrors) {
  const SamplePlan plan({{"a", UniformRange{0, 1}}, {"b", UniformRange{0, 1}}},
                        {.method = SamplingMethod::morris, .samples = 8, .base = {}});
  const auto f = [](const std::vector<double>& x) { return x[0] + x[1] * x[1]; };
  for (const MainEffect& effect :
       main_effects(testing::table(plan), testing::responses(plan, f), {.rows = TableRows::related})) {
    EXPECT_TRUE(std::isnan(effect.variance_share));
    EXPECT_TRUE(std::isnan(effect.share_upper));
    for (const EffectLevel& level : effect.levels) EXPECT_TRUE(std::isnan(level.standard_error));
  }
}

TEST(MainEffects, VarianceShareIsTheFirstOrderIndex) {
  for (const auto& [f, bins] : {std::pair{testing::ishigami(), 40}, {testing::g_function(), 20}}) {
    const SamplePlan plan(f.factors,
                          {.method = SamplingMethod::sobol, .samples = 8192, .seed = 4, .base = {}});
    const auto effects = main_effects(testing::table(plan), testing::responses(plan, f.value),
                                      {.max_values = 12, .bins = bins});
    for (std::size_t j = 0; j < f.factors.size(); ++j) {
      EXPECT_TRUE(effects[j].binned);
      EXPECT_NEAR(effects[j].variance_share, f.first[j], 0.015) << j;
    }
  }
}

TEST(MainEffects, BinsShareTheRowsAndKeepEqualValuesTogether) {
  const int n = 103;
  Eigen::MatrixXd samples(n, 1);
  for (int i = 0; i < n; ++i) samples(i, 0) = (37 * i % n) / 2;  // 52 values, all but one of them twice
  const auto levels =
      main_effects(samples, std::vector<double>(n, 1.0), {.max_values = 51, .bins = 10})[0].levels;
  ASSERT_EQ(levels.size(), 10u);
  std::int64_t rows = 0;
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(static_cast<double>(levels[k].used), 10.3, 1.8);
    EXPECT_TRUE(k == 0 || levels[k].lower > levels[k - 1].upper);
    rows += levels[k].used;
  }
  EXPECT_EQ(rows, n);
}

TEST(MainEffects, CountFailedRowsWhereTheyAre) {
  const Eigen::MatrixXd samples{{1}, {1}, {2}, {2}, {3}};
  const auto levels = main_effects(samples, std::vector<double>{1, nan, nan, nan, 4})[0].levels;
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].used, 1);
  EXPECT_EQ(levels[0].failed, 1);
  EXPECT_EQ(levels[0].mean, 1);
  EXPECT_TRUE(std::isnan(levels[0].standard_error));
  EXPECT_EQ(levels[1].failed, 2);
  EXPECT_TRUE(std::isnan(levels[1].mean));
}

TEST(MainEffects, AConstantResponseHasNoShares) {
  const Eigen::MatrixXd samples{{1}, {1}, {2}, {2}};
  EXPECT_TRUE(std::isnan(main_effects(samples, std::vector<double>(4, 0.1))[0].variance_share));
  EXPECT_TRUE(std::isnan(main_effects(samples, std::vector<double>(4, nan))[0].variance_share));
  EXPECT_TRUE(main_effects(Eigen::MatrixXd(0, 1), {})[0].levels.empty());
}

TEST(MainEffects, RefuseTablesThatDoNotFit) {
  const auto because = [](const char* words) { return ThrowsMessage<InvalidInput>(HasSubstr(words)); };
  const std::vector<double> two = {1, 2};
  EXPECT_THAT([&] { main_effects(Eigen::MatrixXd::Zero(3, 1), two); }, because("2 responses for 3 samples"));
  EXPECT_THAT([&] { main_effects(Eigen::MatrixXd::Zero(2, 0), two); }, because("no factors"));
  EXPECT_THAT(
      [&] {
        main_effects(Eigen::MatrixXd{{1, 2}, {1, nan}}, two);
      },
      because("factor 1 of sample 1 is nan"));
  EXPECT_THAT([&] { main_effects(Eigen::MatrixXd::Zero(2, 1), two, {.bins = 0}); }, because("bins is 0"));
  EXPECT_THAT([&] { main_effects(Eigen::MatrixXd::Zero(2, 1), two, {.max_values = 0}); },
              because("most_values is 0"));
}

TEST(OneAtATimeEffects, SeeEachFactorAlone) {
  const SamplePlan plan({{"a", UniformRange{0, 4}, 5}, {"b", UniformRange{0, 1}, 2}},
                        {.method = SamplingMethod::one_factor, .base = {2, 0.25}});
  const auto f = [](const std::vector<double>& x) { return x[0] * x[0] + 100 * x[1]; };
  const auto effects = one_factor_effects(testing::table(plan), testing::responses(plan, f));
  ASSERT_EQ(effects[0].levels.size(), 5u);
  for (int k = 0; k < 5; ++k) EXPECT_DOUBLE_EQ(effects[0].levels[k].mean, k * k + 25);
  ASSERT_EQ(effects[1].levels.size(), 3u);
  EXPECT_DOUBLE_EQ(effects[1].levels[0].mean, 4);
  EXPECT_DOUBLE_EQ(effects[1].levels[1].mean, 29);
  EXPECT_DOUBLE_EQ(effects[1].levels[2].mean, 104);
  EXPECT_TRUE(std::isnan(effects[1].variance_share));
}

TEST(OneAtATimeEffects, RefuseOtherTables) {
  const auto because = [](const char* words) { return ThrowsMessage<InvalidInput>(HasSubstr(words)); };
  EXPECT_THAT(
      [] {
        one_factor_effects(Eigen::MatrixXd{{0, 0}, {1, 1}}, std::vector<double>{1, 2});
      },
      because("sample 1 differs from the base in factors 0 and 1"));
  EXPECT_THAT([] { one_factor_effects(Eigen::MatrixXd(0, 2), {}); }, because("must have the base"));
}

}  // namespace
}  // namespace kinetix::optim
