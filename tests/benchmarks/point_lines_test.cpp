#include "benchmarks/speed_error/point_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace kinetix::bench {
namespace {

MeasuredPoint some_point() {
  return {"Bullet, direct", "1/60 s, rest 1e-01", "single", 0.1 + 0.2, 1.0 / 3,
          1e-17 / 3,        "not settled",        false};
}

TEST(PointLines, GiveBackEveryFieldToTheLastBit) {
  const MeasuredPoint p = some_point();
  const auto [scene, back] = from_line(to_line("cube, 4 x 4", p));
  EXPECT_EQ(scene, "cube, 4 x 4");
  EXPECT_EQ(back.method, p.method);
  EXPECT_EQ(back.settings, p.settings);
  EXPECT_EQ(back.precision, p.precision);
  EXPECT_EQ(back.seconds, p.seconds);
  EXPECT_EQ(back.spread, p.spread);
  EXPECT_EQ(back.error, p.error);
  EXPECT_EQ(back.status, p.status);
  EXPECT_EQ(back.is_result, p.is_result);
}

TEST(PointLines, KeepErrorsThatAreNoNumber) {
  MeasuredPoint p = some_point();
  p.error = NAN;
  EXPECT_TRUE(std::isnan(from_line(to_line("cube", p)).point.error));
}

TEST(PointLines, RefuseOtherLines) {
  std::string line = to_line("cube", some_point());
  EXPECT_THROW(from_line("cube\t1"), std::runtime_error);
  EXPECT_THROW(from_line(line + "\tmore"), std::runtime_error);
  EXPECT_THROW(from_line(line.replace(line.find("0.3"), 3, "O.3")), std::runtime_error);
}

}  // namespace
}  // namespace kinetix::bench
