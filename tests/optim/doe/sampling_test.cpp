#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <thread>

#include "model/base/invalid_input.hpp"
#include "optim/doe/analysis.hpp"
#include "optim/doe/sampling.hpp"

namespace kinetix::optim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();  // an end that leaves a side open

/// Wichura, algorithm AS 241, Applied Statistics 37, 477 (1988), and tables of the normal distribution.
TEST(NormalSpread, HasThePublishedQuantiles) {
  const Factor standard{"x", NormalSpread{}};
  EXPECT_NEAR(quantile(standard, 0.25), -0.6744897501960817, 1e-15);
  EXPECT_NEAR(quantile(standard, 0.001), -3.090232306167814, 4e-15);
  EXPECT_NEAR(quantile(standard, 1e-20), -9.262340089798408, 1e-14);
  EXPECT_NEAR(quantile(standard, 0.975), 1.959963984540054, 4e-15);
  EXPECT_EQ(quantile(standard, 0.5), 0);
  EXPECT_TRUE(std::isfinite(quantile(standard, 0x1p-53)));
  EXPECT_TRUE(std::isfinite(quantile(standard, 1 - 0x1p-53)));
}

TEST(NormalSpread, IsMovedByItsMeanAndScaledByItsDeviation) {
  EXPECT_NEAR(quantile({"x", NormalSpread{30, 2}}, 0.975), 30 + 2 * 1.959963984540054, 1e-13);
}

double normal_probability(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

TEST(NormalSpread, CutOffKeepsTheShapeInside) {
  for (const auto& [lower, upper] : {std::pair{-1.0, 2.0}, {-2.0, 0.5}, {0.3, infinity}, {-infinity, 0.3}}) {
    const Factor cut{"x", NormalSpread{0, 1, lower, upper}};
    for (const double u : {0.001, 0.2, 0.5, 0.9, 0.9999}) {
      const double z = quantile(cut, u), below = normal_probability(lower);
      EXPECT_NEAR((normal_probability(z) - below) / (normal_probability(upper) - below), u, 1e-14);
    }
  }
}

TEST(NormalSpread, CutOffFarInATailStaysInside) {
  const Factor high{"x", NormalSpread{0, 1, 30, 31}}, low{"x", NormalSpread{0, 1, -31, -30}};
  double before = 30;
  for (const double u : {0x1p-53, 0.1, 0.5, 0.9, 1 - 0x1p-53}) {
    const double z = quantile(high, u);
    EXPECT_GE(z, before);
    EXPECT_LE(z, 31);
    EXPECT_NEAR(z, -quantile(low, 1 - u), 1e-12);
    before = z;
  }
  // The tail falls as exp(-30 x) there: half of it lies below log(2) / 30, up to terms of 1 / 30^2.
  EXPECT_NEAR(quantile(high, 0.5), 30 + std::log(2) / 30, 1e-4);
}

TEST(Factor, LevelsOfARangeHaveBothEnds) {
  const Factor range{"x", UniformRange{0.1, 0.7}, 4};
  EXPECT_EQ(level_count(range), 4);
  EXPECT_EQ(level_value(range, 0), 0.1);
  EXPECT_NEAR(level_value(range, 1), 0.3, 1e-16);
  EXPECT_EQ(level_value(range, 3), 0.7);
}

TEST(Factor, LevelsOfANormalAreMediansOfEqualParts) {
  const Factor normal{"x", NormalSpread{5, 2}, 2};
  EXPECT_NEAR(level_value(normal, 0), 5 - 2 * 0.6744897501960817, 1e-14);
  EXPECT_NEAR(level_value(normal, 1), 5 + 2 * 0.6744897501960817, 1e-14);
}

TEST(Factor, LevelsOfAListAreItsValues) {
  const Factor list{"x", ValueList{{3, 1, 2}}, 50};
  EXPECT_EQ(level_count(list), 3);
  EXPECT_EQ(level_value(list, 1), 1);
  EXPECT_EQ(quantile(list, 0.1), 3);
  EXPECT_EQ(quantile(list, 0.5), 1);
  EXPECT_EQ(quantile(list, 1 - 0x1p-53), 2);
}

TEST(Factor, RefusesWhatIsNoDistribution) {
  const auto refused = [](std::variant<UniformRange, NormalSpread, ValueList> kind, std::int64_t levels = 4) {
    return [=] { Factor{"t", kind, levels}.validate(); };
  };
  const auto because = [](const char* words) { return ThrowsMessage<InvalidInput>(HasSubstr(words)); };
  EXPECT_THAT(refused(UniformRange{2, 1}), because("factor t: range is [2, 1]"));
  EXPECT_THAT(refused(UniformRange{1, 1}), because("lower < upper"));
  EXPECT_THAT(refused(UniformRange{nan, 1}), because("range"));
  EXPECT_THAT(refused(UniformRange{-1e308, 1e308}), because("finite"));
  EXPECT_THAT(refused(NormalSpread{nan, 1}), because("mean"));
  EXPECT_THAT(refused(NormalSpread{0, 0}), because("sd is 0, must be above 0"));
  EXPECT_THAT(refused(NormalSpread{0, nan}), because("sd"));
  EXPECT_THAT(refused(NormalSpread{0, 1, 2, 1}), because("lower < upper"));
  EXPECT_THAT(refused(NormalSpread{0, 1, 50, 51}), because("nothing in [50, 51]"));
  EXPECT_THAT(refused(ValueList{}), because("one or more"));
  EXPECT_THAT(refused(ValueList{{1, nan}}), because("finite"));
  EXPECT_THAT(refused(ValueList{{1, 2, 1}}), because("value 1 is listed twice"));
  EXPECT_THAT(refused(UniformRange{0, 1}, 1), because("levels is 1, must be 2 to"));
  EXPECT_NO_THROW(refused(NormalSpread{0, 1, -infinity, infinity})());
}

using ::testing::ElementsAre;
using Table = std::vector<std::vector<double>>;

// For facts that hold of every method.
constexpr SamplingMethod all_methods[] = {
    SamplingMethod::factorial,  SamplingMethod::lhs,    SamplingMethod::sobol,   SamplingMethod::monte_carlo,
    SamplingMethod::one_factor, SamplingMethod::morris, SamplingMethod::saltelli};

std::vector<Factor> unit_cube(int dimensions) {
  std::vector<Factor> factors;
  for (int j = 0; j < dimensions; ++j) factors.push_back({"x" + std::to_string(j), UniformRange{0, 1}});
  return factors;
}

std::vector<Factor> several_factors() {
  return {{"range", UniformRange{-2, 3}, 3},
          {"normal", NormalSpread{30, 1}, 2},
          {"cut", NormalSpread{0, 1, 0, 2}, 4},
          {"list", ValueList{{5, 7, 1, 9}}}};
}

Table rows(const SamplePlan& plan) {
  Table table;
  for (std::uint64_t i = 0; i < plan.size(); ++i) table.push_back(plan.sample(i));
  return table;
}

SamplingOptions options(SamplingMethod method, std::uint64_t samples = 64, std::uint64_t seed = 1) {
  return {.method = method, .samples = samples, .seed = seed, .base = {}};
}

TEST(SamplePlan, MakesTheSameRowInAnyOrder) {
  for (const SamplingMethod method : all_methods) {
    const SamplePlan plan(several_factors(), options(method)), again(several_factors(), options(method));
    const Table table = rows(plan);
    std::vector<std::uint64_t> order(plan.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    for (const std::uint64_t i : order) EXPECT_EQ(again.sample(i), table[i]);
  }
}

TEST(SamplePlan, MakesTheSameRowsOnSeveralThreads) {
  for (const SamplingMethod method : all_methods) {
    const SamplePlan plan(several_factors(), options(method));
    const Table table = rows(plan);
    Table shared(plan.size());
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t)
      threads.emplace_back([&, t] {
        for (std::uint64_t i = t; i < plan.size(); i += 3) shared[i] = plan.sample(i);
      });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(shared, table);
  }
}

TEST(SamplePlan, AnotherSeedGivesOtherRowsWhereThereIsChance) {
  for (const SamplingMethod method : {SamplingMethod::lhs, SamplingMethod::sobol, SamplingMethod::monte_carlo,
                                      SamplingMethod::morris, SamplingMethod::saltelli})
    EXPECT_NE(rows(SamplePlan(several_factors(), options(method, 64, 1))),
              rows(SamplePlan(several_factors(), options(method, 64, 2))));
}

TEST(SamplePlan, KnowsItsSizeAndSaturates) {
  const auto size = [](const std::vector<Factor>& factors, const SamplingOptions& how) {
    return SamplePlan(factors, how).size();
  };
  const std::uint64_t largest = std::numeric_limits<std::uint64_t>::max(), many = std::uint64_t{1} << 62;
  EXPECT_EQ(size(several_factors(), options(SamplingMethod::factorial)), 3u * 2 * 4 * 4);
  EXPECT_EQ(size(several_factors(), options(SamplingMethod::one_factor)), 1u + 3 + 2 + 4 + 4);
  EXPECT_EQ(size(several_factors(), options(SamplingMethod::lhs, 1000)), 1000u);
  EXPECT_EQ(size(several_factors(), options(SamplingMethod::sobol, 1024)), 1024u);
  EXPECT_EQ(size(several_factors(), options(SamplingMethod::morris, 10)), 50u);
  EXPECT_EQ(size(several_factors(), options(SamplingMethod::saltelli, 1024)), 6144u);
  EXPECT_EQ(size(unit_cube(31), options(SamplingMethod::factorial)), std::uint64_t{1} << 62);
  EXPECT_EQ(size(unit_cube(32), options(SamplingMethod::factorial)), largest);
  EXPECT_EQ(size(unit_cube(4), options(SamplingMethod::saltelli, many)), largest);
  EXPECT_EQ(size(unit_cube(4), options(SamplingMethod::morris, many)), largest);
}

TEST(SamplePlan, LastRowOfALargeTableStaysInsideTheRange) {
  for (const SamplingMethod method :
       {SamplingMethod::lhs, SamplingMethod::sobol, SamplingMethod::monte_carlo}) {
    const SamplePlan plan(unit_cube(3), options(method, std::uint64_t{1} << 62));
    for (const double x : plan.sample(plan.size() - 1)) {
      EXPECT_GT(x, 0);
      EXPECT_LT(x, 1);
    }
  }
}

TEST(Factorial, HoldsEveryCombinationOnceInTheOrderOfNestedLoops) {
  const SamplePlan plan({{"a", ValueList{{1, 2}}}, {"b", UniformRange{0, 1}, 3}},
                        options(SamplingMethod::factorial));
  EXPECT_THAT(rows(plan), ElementsAre(ElementsAre(1, 0), ElementsAre(1, 0.5), ElementsAre(1, 1),
                                      ElementsAre(2, 0), ElementsAre(2, 0.5), ElementsAre(2, 1)));
  const Table table = rows(SamplePlan(several_factors(), options(SamplingMethod::factorial)));
  EXPECT_EQ(std::set<std::vector<double>>(table.begin(), table.end()).size(), 96u);
}

TEST(LatinHypercube, HasOneRowInEachStratum) {
  for (const std::uint64_t n : {1, 2, 10, 777, 20000}) {
    const SamplePlan plan(unit_cube(3), options(SamplingMethod::lhs, n, n));
    std::vector<std::set<std::int64_t>> strata(3);
    for (const auto& row : rows(plan))
      for (int j = 0; j < 3; ++j)
        strata[j].insert(static_cast<std::int64_t>(row[j] * static_cast<double>(n)));
    for (const auto& of_factor : strata) {
      EXPECT_EQ(of_factor.size(), n);
      EXPECT_EQ(*of_factor.begin(), 0);
    }
  }
}

TEST(LatinHypercube, FactorsAreInOrdersOfTheirOwn) {
  const Table table = rows(SamplePlan(unit_cube(2), options(SamplingMethod::lhs, 2000)));
  double covariance = 0;
  for (const auto& row : table) covariance += (row[0] - 0.5) * (row[1] - 0.5) / 2000;
  EXPECT_LT(std::abs(12 * covariance), 3.3 / std::sqrt(2000.0));  // correlation, 0.1 %
}

/// Squared L2 star discrepancy by Warnock's formula.
double discrepancy(const Table& table) {
  const double n = static_cast<double>(table.size()), d = static_cast<double>(table[0].size());
  double single = 0, pairs = 0;
  for (const auto& x : table) {
    double product = 1;
    for (const double coordinate : x) product *= (1 - coordinate * coordinate) / 2;
    single += product;
    for (const auto& y : table) {
      double both = 1;
      for (std::size_t j = 0; j < x.size(); ++j) both *= 1 - std::max(x[j], y[j]);
      pairs += both;
    }
  }
  return std::pow(3, -d) - 2 * single / n + pairs / (n * n);
}

TEST(Sobol, FillsTheCubeBetterThanChance) {
  const auto of = [](SamplingMethod method, std::uint64_t seed) {
    return discrepancy(rows(SamplePlan(unit_cube(4), options(method, 256, seed))));
  };
  // For random points the mean of the square is (2^-d - 3^-d) / n.
  const double by_chance = (std::pow(2, -4) - std::pow(3, -4)) / 256;
  double monte_carlo = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    monte_carlo += of(SamplingMethod::monte_carlo, seed) / 20;
    EXPECT_LT(of(SamplingMethod::sobol, seed), 0.15 * by_chance) << seed;
  }
  EXPECT_NEAR(monte_carlo, by_chance, 0.3 * by_chance);
}

TEST(MonteCarlo, HasTheMomentsOfItsDistributions) {
  const int n = 20000;
  const SamplePlan plan(several_factors(), options(SamplingMethod::monte_carlo, n));
  const double half = std::sqrt(2 * std::numbers::inv_pi);  // mean of a half normal, before the cut at 2
  const double inside = std::erf(std::sqrt(2.0));
  const double cut_mean = half * (1 - std::exp(-2.0)) / inside;
  const double mean[] = {0.5, 30, cut_mean, 5.5};
  const double variance[] = {25.0 / 12, 1, 1 - 2 * half * std::exp(-2.0) / inside - cut_mean * cut_mean,
                             8.75};
  for (int j = 0; j < 4; ++j) {
    double sum = 0, squares = 0;
    for (int i = 0; i < n; ++i) {
      const double x = plan.sample(i)[j] - mean[j];
      sum += x / n;
      squares += x * x / n;
    }
    EXPECT_NEAR(sum, 0, 3.5 * std::sqrt(variance[j] / n)) << j;
    EXPECT_NEAR(squares, variance[j], 0.04 * variance[j]) << j;
  }
}

TEST(OneAtATime, LeavesAllElseAtTheBase) {
  SamplingOptions how = options(SamplingMethod::one_factor);
  how.base = {10, 20};
  const SamplePlan plan({{"a", ValueList{{1, 2}}}, {"b", UniformRange{0, 1}, 3}}, how);
  EXPECT_THAT(rows(plan), ElementsAre(ElementsAre(10, 20), ElementsAre(1, 20), ElementsAre(2, 20),
                                      ElementsAre(10, 0), ElementsAre(10, 0.5), ElementsAre(10, 1)));
}

TEST(OneAtATime, StartsAtTheMiddleWhereNoBaseIsGiven) {
  const SamplePlan plan({{"a", UniformRange{1, 2}}, {"b", NormalSpread{30, 1}}, {"c", ValueList{{4, 5, 6}}}},
                        options(SamplingMethod::one_factor));
  EXPECT_THAT(plan.sample(0), ElementsAre(1.5, 30, 5));
}

TEST(Morris, TrajectoriesMoveEachFactorOnceByHalfItsLevels) {
  std::vector<Factor> factors = unit_cube(5);
  const SamplePlan plan(factors, options(SamplingMethod::morris, 200));
  std::map<double, int> starts;
  for (std::uint64_t r = 0; r < 200; ++r) {
    std::set<std::size_t> moved;
    for (std::uint64_t row = 0; row < 5; ++row) {
      const auto before = plan.sample(6 * r + row), after = plan.sample(6 * r + row + 1);
      for (std::size_t j = 0; j < 5; ++j)
        if (before[j] != after[j]) {
          EXPECT_TRUE(moved.insert(j).second);
          EXPECT_NEAR(std::abs(after[j] - before[j]), 2.0 / 3, 1e-15);
        }
      EXPECT_EQ(moved.size(), row + 1);
    }
    ++starts[plan.sample(6 * r)[0]];
  }
  EXPECT_EQ(starts.size(), 4u);
  for (const auto& [level, count] : starts) EXPECT_NEAR(count, 50, 25) << level;
}

TEST(Morris, StaysOnTheLevelsForAnyNumberOfThem) {
  for (int levels = 2; levels < 8; ++levels) {
    const SamplePlan plan({{"x", UniformRange{0, levels - 1.0}, levels}},
                          options(SamplingMethod::morris, 100));
    for (std::uint64_t r = 0; r < 100; ++r) {
      const double before = plan.sample(2 * r)[0], after = plan.sample(2 * r + 1)[0];
      EXPECT_EQ(std::abs(after - before), levels / 2);
      EXPECT_GE(after, 0);
      EXPECT_LE(after, levels - 1);
    }
  }
}

// Medians of parts of the same probability lie closer in the middle of a normal distribution than at its ends.
TEST(Morris, StepsOfNormalFactorsAreEqual) {
  for (int levels = 2; levels < 12; ++levels)
    for (const NormalSpread& spread : {NormalSpread{0, 1}, NormalSpread{30, 0.2}, NormalSpread{-5, 3, -6, 20},
                                       NormalSpread{1, 2, 0.5, 9}}) {
      const Factor factor{"x", spread, levels};
      const SamplePlan plan({factor, {"y", UniformRange{0, 1}}}, options(SamplingMethod::morris, 100));
      const double ends = level_value(factor, levels - 1) - level_value(factor, 0);
      for (std::uint64_t r = 0; r < 100; ++r) {
        const double step = std::abs(plan.sample(3 * r + 2)[0] - plan.sample(3 * r)[0]);
        EXPECT_NEAR(step, ends * (levels / 2) / (levels - 1), 1e-12 * spread.sd) << levels;
      }
    }
}

TEST(Morris, RefusesFactorsThatRoundingMakesConstant) {
  for (const NormalSpread& spread :
       {NormalSpread{1e6, 1e-12}, NormalSpread{1, 1e-17}, NormalSpread{-3e8, 1e-9}}) {
    const Factor factor{"narrow", spread};
    EXPECT_THAT([&] { SamplePlan({factor}, options(SamplingMethod::morris, 10)); },
                ThrowsMessage<InvalidInput>(HasSubstr("factor narrow: too narrow")));
  }
}

TEST(Saltelli, RowsOfABaseAreAThenAWithOneFactorOfBThenB) {
  const SamplePlan plan(several_factors(), options(SamplingMethod::saltelli, 16));
  for (std::uint64_t n = 0; n < 16; ++n) {
    const auto a = plan.sample(6 * n), b = plan.sample(6 * n + 5);
    for (std::size_t j = 0; j < 4; ++j) {
      auto expected = a;
      expected[j] = b[j];
      EXPECT_EQ(plan.sample(6 * n + 1 + j), expected);
    }
  }
}

TEST(SamplePlan, RefusesWhatCannotBeSampled) {
  const auto refused = [](std::vector<Factor> factors, SamplingOptions how) {
    return [=] { SamplePlan(factors, how); };
  };
  const auto because = [](const char* words) { return ThrowsMessage<InvalidInput>(HasSubstr(words)); };
  EXPECT_THAT(refused({}, {}), because("no factors"));
  EXPECT_THAT(refused({{"a", UniformRange{}}, {"a", UniformRange{}}}, {}),
              because("two factors are called a"));
  EXPECT_THAT(refused({{"a", UniformRange{1, 0}}}, {}), because("factor a: range"));
  EXPECT_THAT(refused(unit_cube(2), options(SamplingMethod::lhs, 0)), because("samples is 0"));
  EXPECT_THAT(refused(unit_cube(3668), options(SamplingMethod::sobol)), because("3668 dimensions"));
  EXPECT_THAT(refused(unit_cube(1834), options(SamplingMethod::saltelli)), because("3668 dimensions"));
  EXPECT_THAT(refused({{"a", ValueList{{1}}}}, options(SamplingMethod::morris)),
              because("two or more for morris"));
  SamplingOptions off = options(SamplingMethod::one_factor);
  off.base = {1, 2, 3};
  EXPECT_THAT(refused(unit_cube(2), off), because("base has 3 values"));
  off.base = {1, std::nan("")};
  EXPECT_THAT(refused(unit_cube(2), off), because("base holds nan"));
}

TEST(SamplePlan, RefusesRowsPastTheEnd) {
  for (const SamplingMethod method : all_methods) {
    const SamplePlan plan(several_factors(), options(method, 4));
    std::vector<double> few(3);
    EXPECT_NO_THROW(plan.sample(plan.size() - 1));
    for (const std::uint64_t past : {plan.size(), plan.size() + 95, ~std::uint64_t{0}})
      EXPECT_THAT([&] { plan.sample(past); },
                  ThrowsMessage<InvalidInput>(HasSubstr("is past the end, must be below")));
    EXPECT_THAT([&] { plan.sample(0, few); },
                ThrowsMessage<InvalidInput>(HasSubstr("3 values for 4 factors")));
  }
}

}  // namespace
}  // namespace kinetix::optim
