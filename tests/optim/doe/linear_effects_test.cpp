#include <gtest/gtest.h>
#include <random>

#include "optim/doe/analysis.hpp"
#include "tests/optim/doe/test_functions.hpp"

namespace kinetix::optim {
namespace {

/// NIST Statistical Reference Datasets: Longley, J. Am. Stat. Assoc. 62, 819 (1967). Certified values.
TEST(LinearEffects, AreTheCertifiedOnesOfLongleysData) {
  const Eigen::MatrixXd samples{
      {83.0, 234289, 2356, 1590, 107608, 1947},  {88.5, 259426, 2325, 1456, 108632, 1948},
      {88.2, 258054, 3682, 1616, 109773, 1949},  {89.5, 284599, 3351, 1650, 110929, 1950},
      {96.2, 328975, 2099, 3099, 112075, 1951},  {98.1, 346999, 1932, 3594, 113270, 1952},
      {99.0, 365385, 1870, 3547, 115094, 1953},  {100.0, 363112, 3578, 3350, 116219, 1954},
      {101.2, 397469, 2904, 3048, 117388, 1955}, {104.6, 419180, 2822, 2857, 118734, 1956},
      {108.4, 442769, 2936, 2798, 120445, 1957}, {110.8, 444546, 4681, 2637, 121950, 1958},
      {112.6, 482704, 3813, 2552, 123366, 1959}, {114.2, 502601, 3931, 2514, 125368, 1960},
      {115.7, 518173, 4806, 2572, 127852, 1961}, {116.9, 554894, 4007, 2827, 130081, 1962}};
  const std::vector<double> employment = {60323, 61122, 60171, 61187, 63221, 63639, 64989, 63761,
                                          66019, 67857, 68169, 66513, 68655, 69564, 69331, 70551};
  const double slopes[] = {15.0618722713733,  -0.0358191792925910, -2.02022980381683,
                           -1.03322686717359, -0.0511041056535807, 1829.15146461355};
  const double errors[] = {84.9149257747669,  0.0334910077722432, 0.488399681651699,
                           0.214274163161675, 0.226073200069370,  455.478499142212};
  const LinearModel model = linear_effects(samples, employment);
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(model.factors[j].slope / slopes[j], 1, 1e-8) << j;
    EXPECT_NEAR(model.factors[j].slope_error / errors[j], 1, 1e-8) << j;
  }
  EXPECT_NEAR(model.r_squared, 0.995479004577296, 1e-12);
  EXPECT_EQ(model.used, 16);
}

/// Anscombe, Am. Stat. 27, 17 (1973), the first of his four sets.
TEST(LinearEffects, AreThosePublishedForAnscombesData) {
  const Eigen::MatrixXd samples{{10}, {8}, {13}, {9}, {11}, {14}, {6}, {4}, {12}, {7}, {5}};
  const LinearModel model = linear_effects(
      samples, std::vector<double>{8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68});
  EXPECT_NEAR(model.factors[0].slope, 0.500, 5e-4);
  EXPECT_NEAR(model.factors[0].slope_error, 0.118, 5e-4);
  EXPECT_NEAR(model.factors[0].correlation, 0.816, 5e-4);
  EXPECT_NEAR(model.factors[0].standardised, model.factors[0].correlation, 1e-14);
  EXPECT_NEAR(model.r_squared, 0.667, 5e-4);
}

TEST(LinearEffects, RankCorrelationSeesOrderAloneAndSharesTies) {
  const Eigen::MatrixXd samples{{1, 1}, {2, 2}, {2.5, 2}, {9, 3}};
  const LinearModel model = linear_effects(samples, std::vector<double>{1, 10, 100, 1e6});
  EXPECT_DOUBLE_EQ(model.factors[0].rank_correlation, 1);
  EXPECT_DOUBLE_EQ(model.factors[1].rank_correlation, 4.5 / std::sqrt(4.5 * 5));
  EXPECT_LT(model.factors[0].correlation, 0.99);
}

TEST(LinearEffects, OfAPlaneAreItsSlopesWhereRowsFailed) {
  const std::vector<Factor> factors = {
      {"a", UniformRange{-1, 4}}, {"b", NormalSpread{0, 2}}, {"held", ValueList{{7}}}};
  const SamplePlan plan(factors, {.method = SamplingMethod::lhs, .samples = 50, .base = {}});
  auto responses = testing::responses(plan, [](const auto& x) { return 3 - 2 * x[0] + 0.5 * x[1]; });
  for (const int i : {0, 7, 49}) responses[i] = nan;
  const LinearModel model = linear_effects(testing::table(plan), responses);
  EXPECT_EQ(model.used, 47);
  EXPECT_EQ(model.failed, 3);
  EXPECT_NEAR(model.factors[0].slope, -2, 1e-12);
  EXPECT_NEAR(model.factors[1].slope, 0.5, 1e-12);
  EXPECT_NEAR(model.r_squared, 1, 1e-12);
  EXPECT_TRUE(std::isnan(model.factors[2].slope));
  EXPECT_TRUE(std::isnan(model.factors[2].correlation));
}

TEST(LinearEffects, AreNotKnownForDependentFactorsOrTooFewRows) {
  Eigen::MatrixXd twins(10, 2);
  twins.col(0).setLinSpaced(0, 1);
  twins.col(1) = 3 - 2 * twins.col(0).array();
  const std::vector<double> responses = {1, 2, 4, 3, 5, 7, 6, 8, 9, 10};
  const LinearModel dependent = linear_effects(twins, responses);
  EXPECT_TRUE(std::isnan(dependent.factors[0].slope));
  EXPECT_TRUE(std::isnan(dependent.r_squared));
  EXPECT_NEAR(dependent.factors[0].correlation, -dependent.factors[1].correlation, 1e-14);
  const LinearModel few =
      linear_effects(Eigen::MatrixXd{{0, 1}, {1, 0}, {2, 5}}, std::vector<double>{1, 2, 4});
  EXPECT_TRUE(std::isnan(few.factors[0].slope));
  EXPECT_TRUE(std::isnan(linear_effects(twins, std::vector<double>(10, 0.1)).factors[0].correlation));
  EXPECT_EQ(linear_effects(twins, std::vector<double>(10, nan)).used, 0);
}

/// The first 20 of 80 factors together have the share `share` of the responses; the rest is noise.
TEST(LinearShare, OfAFamilyIsRightInTheMeanWithMoreFactorsThanRowsAsWell) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  constexpr int tables = 400, rows = 60, factors = 80, own = 20;
  for (const double share : {0.0, 0.4, 0.9}) {
    double sum = 0;
    int held = 0;
    for (int table = 0; table < tables; ++table) {
      Eigen::MatrixXd x(rows, factors);
      for (double& value : x.reshaped()) value = normal(random);
      Eigen::VectorXd y = std::sqrt(share / own) * x.leftCols(own).rowwise().sum();
      for (double& value : y) value += std::sqrt(1 - share) * normal(random);
      const LinearModel model = linear_effects(x, std::vector<double>(y.begin(), y.end()));
      std::vector<double> correlations;
      for (int f = 0; f < own; ++f) correlations.push_back(model.factors[f].correlation);
      const Estimate found = linear_share(correlations, model.used);
      sum += found.value;
      held += found.lower <= share && share <= found.upper;
    }
    EXPECT_NEAR(sum / tables, share, 3.0 / rows) << share;
    EXPECT_GE(held, tables * 0.93) << share;
  }
}

TEST(LinearShare, IsNotKnownOfNoRowsOrFactorsThatDoNotVary) {
  EXPECT_TRUE(std::isnan(linear_share(std::vector<double>{0.5}, 2).value));
  EXPECT_TRUE(std::isnan(linear_share(std::vector<double>{nan, nan}, 50).value));
  EXPECT_NEAR(linear_share(std::vector<double>{1, nan}, 50).value, 1, 1e-14) << "a plane in one factor";
}

}  // namespace
}  // namespace kinetix::optim
