#include "model/elastic/path/turning_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::model {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A path with these loads at theta 0, 1, 2, ...
EquilibriumPath with_loads(const std::vector<double>& loads) {
  EquilibriumPath path;
  for (const double load : loads) {
    EquilibriumStep step;
    step.theta = static_cast<double>(path.steps.size());
    step.load = load;
    path.steps.push_back(step);
  }
  return path;
}

std::vector<double> limit_thetas(const std::vector<double>& loads) {
  std::vector<double> thetas;
  for (const PathEvent& event : limit_points(with_loads(loads))) thetas.push_back(event.at.theta);
  return thetas;
}

TEST(LimitPoints, AreMaximaAndMinimaThatStandOut) {
  EXPECT_THAT(limit_thetas({0, 3, 5, 4, 1, 2, 6}), ElementsAre(2, 4));
  EXPECT_THAT(limit_thetas({0, -3, -5, -4, -6}), ElementsAre(2, 3));
  EXPECT_THAT(limit_thetas({0, 5, 5, 1}), ElementsAre(1));
  EXPECT_THAT(limit_thetas({0, 1, 2, 3}), IsEmpty());
  EXPECT_THAT(limit_thetas({0, 0, 0}), IsEmpty());
  EXPECT_THAT(limit_thetas({0}), IsEmpty());
  EXPECT_THAT(limit_thetas({}), IsEmpty());
}

TEST(LimitPoints, OfLessThanTwoPercentOfTheSpanAreNone) {
  EXPECT_THAT(limit_thetas({0, 50, 48.1, 100}), IsEmpty());
  EXPECT_THAT(limit_thetas({0, 50, 47.9, 100}), ElementsAre(1, 2));
  EXPECT_THAT(limit_thetas({0, 99, 98.5, 100, 0}), ElementsAre(3)) << "a dent in a peak";
}

TEST(LimitPoints, SayWhichTheyAreAndAtWhatLoad) {
  const std::vector<PathEvent> events = limit_points(with_loads({0, 5, 1, 6}));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, PathEvent::Kind::limit_point);
  EXPECT_EQ(events[0].what, "the load reached a maximum");
  EXPECT_EQ(events[0].at.load, 5);
  EXPECT_EQ(events[0].since, 0);
  EXPECT_EQ(events[1].what, "the load reached a minimum");
  EXPECT_EQ(events[1].at.load, 1);
}

TEST(LimitPoints, StandAmongTheOtherEventsInTheOrderOfThePath) {
  EquilibriumPath path = with_loads({0, 5, 1, 6});
  for (const double theta : {0.5, 1.0, 3.0}) path.events.push_back({PathEvent::Kind::snap, {theta}, 0, ""});
  add_limit_points(path);
  std::vector<double> thetas;
  for (const PathEvent& event : path.events) thetas.push_back(event.at.theta);
  EXPECT_THAT(thetas, ElementsAre(0.5, 1, 1, 2, 3));
}

TEST(LimitPoints, AreNotWherePlatesLetGoAtTheEnd) {
  EquilibriumPath path = with_loads({0, 3, 5, 1});
  ASSERT_EQ(limit_points(path).size(), 1u);
  path.let_go = 1;
  EXPECT_THAT(limit_points(path), IsEmpty()) << "the last load is of other rows than those before it";
}

/// Up to the barrier and down behind it: the steepest rise and the steepest fall of the energy.
TEST(LimitPoints, OfATwistUnitAreOnBothSidesOfItsBarrier) {
  const CellTuple unit{.A_in = {pi / 2, pi / 3, pi / 2, pi / 3}};
  const Structure twist = tiled(1, 1, unit, unit);
  const EquilibriumPath path = trace_equilibrium(
      driven(twist, hinge_drive(twist, {{0, 0}, Axis::y}, -pi / 4)), {.k_turn = 1e-5}, without_contact());
  const std::vector<PathEvent> events = limit_points(path);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_GT(events[0].at.theta, -pi / 8);
  EXPECT_LT(events[1].at.theta, -pi / 8);
  EXPECT_LT(events[0].at.load * events[1].at.load, 0);
}

EquilibriumStep at(double drive, double load, double energy) {
  EquilibriumStep step;
  step.theta = step.drive = drive;
  step.load = load;
  step.energy = energy;
  return step;
}

/// Maximum or minimum, and the drive before and after.
using Turn = std::tuple<bool, double, double>;

std::vector<Turn> turns(const std::vector<EquilibriumStep>& steps) {
  EnergyTurns seen{LinkageDrive{}};
  for (const EquilibriumStep& step : steps) seen.see(step, {});
  std::vector<Turn> found;
  for (const EnergyTurn& turn : seen.turns())
    found.emplace_back(turn.maximum, turn.before.step.drive, turn.after.step.drive);
  return found;
}

TEST(EnergyTurns, AreWhereTheLoadChangesItsSign) {
  const std::vector<EquilibriumStep> up_down_up = {at(0, 0, 0), at(1, 2, 1), at(2, -1, 2), at(3, -2, 1),
                                                   at(4, 1, 1)};
  EXPECT_THAT(turns(up_down_up), ElementsAre(Turn{true, 1, 2}, Turn{false, 3, 4}));
  const std::vector<EquilibriumStep> backwards = {at(0, 0, 0), at(-1, -2, 1), at(-2, 1, 2)};
  EXPECT_THAT(turns(backwards), ElementsAre(Turn{true, -1, -2}));
  EXPECT_THAT(turns({at(0, 0, 0), at(1, 1, 1), at(2, 2, 3)}), IsEmpty());
}

TEST(EnergyTurns, AJumpDownBetweenRisingEnergiesIsAMaximumAndAMinimum) {
  EXPECT_THAT(turns({at(0, 0, 0), at(1, 1, 1), at(2, 1, 0.5), at(3, 1, 1.5)}),
              ElementsAre(Turn{true, 1, 2}, Turn{false, 1, 2}));
}

TEST(EnergySummit, OfAJumpIsTheStateBeforeItWhereTheLoadDoesNotVanish) {
  const CellTuple unit{.A_in = {pi / 2, pi / 3, pi / 2, pi / 3}};
  const Structure s = tiled(1, 1, unit, unit);
  const EnergyTurn jump{true, {at(0.1, 1, 5), rest_state(s)}, {at(0.2, 1, 2), rest_state(s)}};
  const EnergyBarrier barrier =
      energy_summit(s, {.k_turn = 1e-5}, drive_on(s, search_drives(s, 1)[0]), {}, jump);
  EXPECT_EQ(barrier.energy, 5);
  EXPECT_EQ(barrier.theta, 0) << "of the sheet, which is flat, and not of the drive";
  EXPECT_EQ(barrier.drive, 0.1);
  EXPECT_FALSE(barrier.load_vanishes);
}

}  // namespace
}  // namespace kinetix::model
