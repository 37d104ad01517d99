#include "benchmarks/speed_error/pareto.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace kinetix::bench {
namespace {

using ::testing::ElementsAre;

MeasuredPoint point(double seconds, double error, const std::string& method = "some") {
  return {.method = method, .precision = "double", .seconds = seconds, .error = error};
}

std::vector<double> seconds_of(const MeasuredPoints& points) {
  std::vector<double> seconds;
  for (const MeasuredPoint& p : points) seconds.push_back(p.seconds);
  return seconds;
}

TEST(ParetoFront, KeepsWhatNoOtherPointBeatsFromFastToAccurate) {
  const MeasuredPoints points = {point(3, 0.1), point(1, 0.5), point(2, 0.6), point(4, 0.2), point(5, 0.01)};
  EXPECT_THAT(seconds_of(pareto_front(points)), ElementsAre(1, 3, 5));
}

TEST(ParetoFront, LeavesOutPointsWithoutAState) {
  const MeasuredPoints points = {point(1, NAN), point(2, INFINITY), point(NAN, 0.1), point(0, 0.1),
                                 point(3, 0.2)};
  EXPECT_THAT(seconds_of(pareto_front(points)), ElementsAre(3));
}

TEST(ParetoFront, KeepsOneOfTwoEqualPoints) {
  EXPECT_THAT(seconds_of(pareto_front({point(1, 0.1), point(1, 0.1)})), ElementsAre(1));
}

TEST(ParetoFront, IsWhatTheDefinitionGivesForRandomPoints) {
  constexpr unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.1, 1);
  MeasuredPoints points;
  for (int k = 0; k < 200; ++k) points.push_back(point(unit(random), unit(random)));
  std::size_t unbeaten = 0;
  for (const MeasuredPoint& p : points) {
    const auto beats = [&](const MeasuredPoint& q) { return q.seconds < p.seconds && q.error < p.error; };
    unbeaten += std::none_of(points.begin(), points.end(), beats);
  }
  EXPECT_EQ(pareto_front(points).size(), unbeaten);
}

TEST(FastestAt, TakesTheFastestThatIsAccurateEnough) {
  const MeasuredPoints points = {point(1, 2e-2), point(9, 1e-9), point(3, 1e-3), point(2, 1.1e-3),
                                 point(4, 5e-4)};
  EXPECT_EQ(fastest_at(points, 1e-3)->seconds, 3);
  EXPECT_EQ(fastest_at(points, 1e-2)->seconds, 2);
  EXPECT_EQ(fastest_at(points, 1e-10), std::nullopt);
}

TEST(Series, AreNamedByMethodAndSinglePrecisionInOrder) {
  MeasuredPoints points = {point(1, 1, "b"), point(2, 1, "a"), point(3, 1, "b")};
  points[2].precision = "single";
  EXPECT_THAT(series_in(points), ElementsAre("b", "a", "b, single precision"));
  EXPECT_THAT(seconds_of(of_series(points, "b")), ElementsAre(1));
}

TEST(Series, TellThePhysicsEngineFromTheModels) {
  const MeasuredPoints points = {point(1, 1, "exact"), point(2, 1, "Bullet, direct"),
                                 point(3, 1, "Bullet, direct")};
  EXPECT_THAT(seconds_of(of_bullet(points)), ElementsAre(2, 3));
  EXPECT_THAT(seconds_of(without_bullet(points)), ElementsAre(1));
}

}  // namespace
}  // namespace kinetix::bench
