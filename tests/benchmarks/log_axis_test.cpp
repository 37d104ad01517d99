#include "benchmarks/speed_error/log_axis.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace kinetix::bench {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

TEST(LogAxis, PlacesPowersOfTenAtEvenDistances) {
  const LogAxis axis{1e-6, 100, 10, 90};
  for (int exponent = -6; exponent <= 2; ++exponent)
    EXPECT_NEAR(axis.place(std::pow(10, exponent)), 10 + 10 * (exponent + 6), 1e-9);
}

TEST(LogAxis, RunsBackwardsWhereItsLowEndIsDrawnLast) {
  const LogAxis axis{1, 100, 50, 0};
  EXPECT_NEAR(axis.place(10), 25, 1e-9);
}

TEST(LogAxis, DrawsValuesOutsideAtItsEnds) {
  const LogAxis axis{1, 100, 0, 50};
  EXPECT_EQ(axis.place(1e9), 50);
  EXPECT_EQ(axis.place(1e-9), 0);
  EXPECT_EQ(axis.place(0), 0);
}

TEST(LogAxis, HasTheTicksThatLieOnIt) {
  const LogAxis axis{2e-3, 10, 0, 1};
  EXPECT_THAT(axis.ticks(), ElementsAre(DoubleEq(1e-2), DoubleEq(1e-1), DoubleEq(1), DoubleEq(10)));
  EXPECT_THAT(axis.ticks(2), ElementsAre(DoubleEq(1e-2), DoubleEq(1)));
}

TEST(TimeLabel, HasTwoDigitsAndTheUnitThatFits) {
  EXPECT_EQ(time_label(1.53e-6), "1.5 us");
  EXPECT_EQ(time_label(23.4e-6), "23 us");
  EXPECT_EQ(time_label(0.0123), "12 ms");
  EXPECT_EQ(time_label(0.9951), "1.0 s");
  EXPECT_EQ(time_label(8.45), "8.4 s");
}

TEST(CountLabel, HasTwoDigitsAndSpacesBetweenThousands) {
  EXPECT_EQ(count_label(1.46), "1.5");
  EXPECT_EQ(count_label(9.96), "10");
  EXPECT_EQ(count_label(994), "990");
  EXPECT_EQ(count_label(1234), "1200");
  EXPECT_EQ(count_label(33716), "34 000");
  EXPECT_EQ(count_label(1.96e6), "2 000 000");
}

TEST(PowerLabel, RaisesExponentsThatAreFarFromZero) {
  EXPECT_EQ(power_label(100), "100");
  EXPECT_EQ(power_label(0.01), "0.01");
  EXPECT_NE(power_label(1e-6).find(">\u22126</tspan>"), std::string::npos);
}

}  // namespace
}  // namespace kinetix::bench
