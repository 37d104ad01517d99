#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"
#include "optim/doe/analysis.hpp"
#include "tests/optim/doe/test_functions.hpp"

namespace kinetix::optim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

SamplePlan trajectories(std::vector<Factor> factors, std::uint64_t count) {
  return {std::move(factors), {.method = SamplingMethod::morris, .samples = count, .seed = 2, .base = {}}};
}

std::vector<Factor> mixed_factors() {
  return {{"range", UniformRange{-2, 3}}, {"normal", NormalSpread{30, 1}}, {"list", ValueList{{1, 9, 4}}}};
}

double linear(const std::vector<double>& x) { return 5 + 2 * x[0] - 3 * x[1] + 0.5 * x[2]; }

TEST(MorrisEffects, OfALinearFunctionAreExact) {
  const SamplePlan plan = trajectories(mixed_factors(), 20);
  const auto effects = morris_effects(testing::table(plan), testing::responses(plan, linear));
  const double two_quantiles = 2 * 1.1503493803760079;  // of a normal distribution, from 1/8 to 7/8
  const double expected[] = {2 * 5, -3 * two_quantiles, 0.5 * 8};
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(effects[j].mu.value, expected[j], 1e-12) << j;
    EXPECT_NEAR(effects[j].mu.lower, expected[j], 1e-12) << j;
    EXPECT_NEAR(effects[j].mu.upper, expected[j], 1e-12) << j;
    EXPECT_NEAR(effects[j].mu_star.value, std::abs(expected[j]), 1e-12) << j;
    EXPECT_NEAR(effects[j].sigma.value, 0, 1e-12) << j;
    EXPECT_EQ(effects[j].used, 20);
    EXPECT_EQ(effects[j].dropped, 0);
  }
}

// For a square, a step of h from x has the slope 2 x + h. With steps of one size, effects on both sides of the mean
// balance.
TEST(MorrisEffects, OfASquareOfANormalFactorBalance) {
  for (const int levels : {4, 6, 8, 10}) {
    const Factor factor{"x", NormalSpread{0, 1}, levels};
    const SamplePlan plan = trajectories({factor}, 4000);
    const auto square = [](const std::vector<double>& x) { return x[0] * x[0]; };
    const MorrisEffect effect = morris_effects(testing::table(plan), testing::responses(plan, square))[0];
    // Levels below the middle are stepped up from, those above it down: slopes x + x' are those of the middle of a step.
    const double span = 2 * level_value(factor, levels - 1), apart = span / (levels - 1);
    double squares = 0;
    for (int k = 0; k < levels / 2; ++k) squares += std::pow((2 * k - levels / 2 + 1) * apart * span, 2);
    EXPECT_NEAR(effect.mu.value, 0, 0.06 * span * span) << levels;
    EXPECT_NEAR(effect.sigma.value, std::sqrt(squares / (levels / 2)), 0.03 * effect.sigma.value) << levels;
  }
}

/// On levels 0, 1/3, 2/3, 1 the effect of x in x (y - 1/2) is y - 1/2 of the level.
TEST(MorrisEffects, OfAProductHaveTheLevelsMoments) {
  const SamplePlan plan = trajectories({{"x", UniformRange{0, 1}}, {"y", UniformRange{0, 1}}}, 4000);
  const auto product = [](const std::vector<double>& x) { return x[0] * (x[1] - 0.5); };
  const MorrisEffect of_x = morris_effects(testing::table(plan), testing::responses(plan, product))[0];
  const double sd = std::sqrt(5.0) / 6;
  EXPECT_NEAR(of_x.mu.value, 0, 3.5 * sd / std::sqrt(4000.0));
  EXPECT_NEAR(of_x.mu_star.value, 1.0 / 3, 0.01);
  EXPECT_NEAR(of_x.sigma.value, sd, 0.01);
  EXPECT_LE(of_x.mu.lower, of_x.mu.value);
  EXPECT_LE(of_x.mu.value, of_x.mu.upper);
  EXPECT_NEAR(of_x.mu.upper - of_x.mu.lower, 2 * 1.96 * sd / std::sqrt(4000.0), 4e-3);
}

TEST(MorrisEffects, AFailedRowDropsTheEffectsAtItsTwoSides) {
  const SamplePlan plan = trajectories(mixed_factors(), 20);
  std::vector<double> responses = testing::responses(plan, linear);
  responses[4 * 3 + 1] = nan;
  const auto effects = morris_effects(testing::table(plan), responses);
  std::int64_t dropped = 0;
  for (const MorrisEffect& effect : effects) {
    EXPECT_EQ(effect.used + effect.dropped, 20);
    EXPECT_LE(effect.dropped, 1);
    dropped += effect.dropped;
  }
  EXPECT_EQ(dropped, 2);
  EXPECT_NEAR(effects[0].mu.value, 10, 1e-12);
}

TEST(MorrisEffects, AreNotKnownWhereAllFailed) {
  const SamplePlan plan = trajectories(mixed_factors(), 3);
  const auto effects = morris_effects(testing::table(plan), std::vector<double>(12, nan));
  EXPECT_TRUE(std::isnan(effects[0].mu.value));
  EXPECT_TRUE(std::isnan(effects[0].mu_star.upper));
  EXPECT_EQ(effects[0].dropped, 3);
}

TEST(MorrisEffects, RefuseATableThatIsNotOfTrajectories) {
  const auto because = [](const char* words) { return ThrowsMessage<InvalidInput>(HasSubstr(words)); };
  const std::vector<double> responses(3, 1.0);
  const auto refused = [&](const Eigen::MatrixXd& samples) {
    return [&, samples] { morris_effects(samples, responses); };
  };
  EXPECT_THAT(refused(Eigen::MatrixXd{{0, 0}, {1, 1}, {1, 0}}),
              because("samples 0 and 1 differ in 2 factors"));
  EXPECT_THAT(refused(Eigen::MatrixXd{{0, 0}, {1, 0}, {0, 0}}), because("moves factor 0 twice"));
  EXPECT_THAT(refused(Eigen::MatrixXd{{0, 0}, {1, 0}}), because("3 responses for 2 samples"));
  EXPECT_THAT(refused(Eigen::MatrixXd{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), because("must be a multiple of 4"));
}

}  // namespace
}  // namespace kinetix::optim
