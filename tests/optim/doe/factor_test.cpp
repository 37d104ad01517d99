#include "optim/doe/factor.hpp"
#include "optim/doe/nan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/base/invalid_input.hpp"

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

}  // namespace
}  // namespace kinetix::optim
