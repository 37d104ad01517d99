#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <functional>
#include <optional>
#include <random>

#include "model/closure/closure.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/elastic/path/stable_states.hpp"
#include "model/elastic/path/turning_points.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"
#include "tests/support/random_elastic.hpp"

/// Tests that the events of a path do not depend on how far the drive is requested to go.
namespace kinetix::model {
namespace {

using namespace testing;
using ::testing::IsEmpty;
using Stop = EquilibriumPath::Stop;

// rad: events are located to a thousandth of it.
constexpr double same = 1e-6;
// N/mm, N mm/rad, mm: the twist unit of the cases, with the usual stiffness.
const Elasticity hinges{.k_point = 1000, .k_turn = 0.1, .reach_mm = 1.8};

EquilibriumPathOptions make_run_step_options() {
  EquilibriumPathOptions options;
  options.longest_step = 0.06;
  return options;
}

struct Asked {
  EquilibriumPath path;
  StableStates stable;
};

Asked follow(const DrivenLinkage& driven, const Elasticity& elasticity = hinges,
             const EquilibriumPathOptions& options = make_run_step_options()) {
  EnergyTurns turns(driven.drive);
  LoadTurns load_turns;
  Asked out;
  out.path =
      trace_equilibrium(driven, elasticity, options, [&](const EquilibriumStep& step, const State& state) {
        turns.see(step, state);
        load_turns.see(step, state);
      });
  add_limit_points(out.path, located_limit_points(driven.linkage, elasticity, driven.drive, options,
                                                  load_turns, out.path));
  follow_descent(driven, elasticity, options, turns);
  out.stable = stable_states(driven.linkage, elasticity, {turns}, {.path = options});
  return out;
}

/// The paper's twist unit, driven by a hinge that is turned by `asked_deg`, which folds it to minus half of that.
DrivenLinkage twist_unit(double alpha_deg, const CellSize& size, double asked_deg) {
  const double alpha = alpha_deg * radians_per_degree;
  const CellTuple unit{.A_in = {pi / 2, alpha, pi / 2, alpha}};
  const Structure s = tiled(1, 1, unit, unit, size);
  return driven(s, hinge_drive(s, {{0, 0}, Axis::x}, -asked_deg / 2 * radians_per_degree));
}

std::vector<PathEvent> events_before(const EquilibriumPath& path, double theta) {
  std::vector<PathEvent> events;
  for (const PathEvent& event : path.events)
    if (std::abs(event.at.theta) < theta - same) events.push_back(event);
  return events;
}

/// Checks that events and stable states of a path are among those of a path that goes further.
void expect_part_of(const Asked& shorter, const Asked& longer) {
  const double end = std::abs(shorter.path.theta);
  const std::vector<PathEvent> some = events_before(shorter.path, end), all = events_before(longer.path, end);
  ASSERT_EQ(some.size(), all.size());
  for (std::size_t k = 0; k < some.size(); ++k) {
    EXPECT_EQ(some[k].kind, all[k].kind) << some[k].what << "; " << all[k].what;
    EXPECT_NEAR(some[k].at.theta, all[k].at.theta, same) << some[k].what;
  }
  const auto is_among = [](const StableState& state, const StableStates& states) {
    return std::any_of(states.states.begin(), states.states.end(), [&](const StableState& other) {
      return std::abs(state.theta - other.theta) <= same && std::abs(state.energy - other.energy) <= 1e-3;
    });
  };
  for (const StableState& state : shorter.stable.states)
    EXPECT_TRUE(is_among(state, longer.stable)) << state.how << ", theta " << state.theta;
  for (const StableState& state : longer.stable.states)
    if (std::abs(state.theta) < end - same) {
      EXPECT_TRUE(is_among(state, shorter.stable)) << state.how << ", theta " << state.theta;
    }
}

/// Drives a twist unit to angles, each larger than the one before, deg.
void expect_same_events_of_twist_units(const std::vector<double>& angles) {
  for (const double alpha : {60, 70, 80})
    for (const double thickness_mm : {0.01, 0.1, 1.0}) {
      SCOPED_TRACE(::testing::Message() << "alpha " << alpha << ", walls of " << thickness_mm << " mm");
      std::vector<Asked> asked;
      for (const double angle : angles)
        asked.push_back(follow(twist_unit(alpha, {10, thickness_mm, 6}, angle)));
      for (std::size_t k = 1; k < asked.size(); ++k) {
        expect_part_of(asked[k - 1], asked[k]);
        EXPECT_EQ(asked[k].stable.states.size(), 2u);
      }
    }
}

TEST(AskedAngle, OfATwistUnitChangesNeitherEventsNorStableStates) {
  expect_same_events_of_twist_units({78, 86, 100});
}

TEST(AskedAngleSoak, OfATwistUnitChangesNeitherEventsNorStableStates) {
  expect_same_events_of_twist_units({78, 82, 86, 92, 100});
}

/// Unit of twist_unit.yaml: its walls stop it before the state of Eq. 6, and it locks soon after.
TEST(AskedAngle, OfATwistUnitWithWallsIsReachedOrLockedAtOnePlace) {
  std::vector<double> locked;
  for (double angle = 80; angle <= 100; angle += 4) {
    const Asked unit = follow(twist_unit(60, {10, 0.8, 6}, angle));
    if (unit.path.stop == Stop::locked) locked.push_back(unit.path.theta);
    if (unit.path.stop == Stop::reached) {
      EXPECT_TRUE(locked.empty()) << angle << " deg is reached, and less is not";
    }
  }
  for (const double theta : locked) EXPECT_NEAR(theta, locked.front(), same);
}

/// Very thin walls reach the state of Eq. 6, where their tips meet at 45 deg.
TEST(AskedAngle, OfATwistUnitOfThreadsFindsEquationSixAndEndsThere) {
  const double alpha_deg = 60;
  for (double angle = 86; angle <= 100; angle += 2) {
    SCOPED_TRACE(angle);
    const Asked unit = follow(twist_unit(alpha_deg, {10, 0.001, 0.01}, angle));
    ASSERT_EQ(unit.stable.states.size(), 2u);
    EXPECT_THAT(unit.stable.unresolved, IsEmpty());
    // The springs pull it back by as much as the hinges yield.
    EXPECT_NEAR(unit.stable.states[1].theta, -45 * radians_per_degree, 5e-4);
    if (angle <= 90) continue;
    EXPECT_EQ(unit.path.stop, Stop::locked) << unit.path.why;
    EXPECT_NEAR(unit.path.theta, -45 * radians_per_degree, 5e-4);
  }
}

/// Drives scenes to thetas, each larger than the one before, rad. The scenes are a twist unit and a square panel between
/// plates, and a strip and a panel in space that a hinge folds.
void expect_same_events_of_scenes(const std::vector<double>& thetas) {
  const CellTuple unit{.A_in = {pi / 2, pi / 3, pi / 2, pi / 3}};
  const Structure twist = tiled(1, 1, unit, unit, {10, 0.8, 6}), strip = twisting_strip();
  std::mt19937 random(5);
  Structure panel = random_panel(3, 2, random);
  const std::vector<std::function<DrivenLinkage(double)>> scenes = {
      [&](double theta) { return driven(twist, plates_drive(Axis::y, -theta)); },
      [&](double theta) {
        return driven(strip, hinge_drive(strip, {{0, 0}, Axis::x}, theta));
      },
      [&](double theta) { return driven(panel, drive_to(panel, theta)); },
      [&](double theta) {
        return driven(make_structure(rectangle(2, 2), {}), plates_drive(Axis::y, theta));
      }};
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    std::optional<Asked> last;
    for (const double theta : thetas) {
      SCOPED_TRACE(::testing::Message() << "scene " << k << ", theta " << theta);
      Asked next = follow(scenes[k](theta));
      if (last) expect_part_of(*last, next);
      last = std::move(next);
    }
  }
}

TEST(AskedAngle, OfOtherSheetsAndDrivesChangesNoEvent) { expect_same_events_of_scenes({0.3, 0.6, 0.8}); }

TEST(AskedAngleSoak, OfOtherSheetsAndDrivesChangesNoEvent) {
  expect_same_events_of_scenes({0.3, 0.45, 0.6, 0.7, 0.8});
}

/// Calls visit(one box, another one) for all half walls that may meet: not of one body or of one hinge.
template <class Visit>
void for_each_pair(const Structure& s, const State& state, const Visit& visit) {
  const std::vector<HalfWall> walls = half_walls(s);
  for (std::size_t a = 0; a < walls.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (walls[a].body != walls[b].body && walls[a].hinge != walls[b].hinge)
        visit(placed(walls[a], state[walls[a].body]), placed(walls[b], state[walls[b].body]));
}

double min_gap(const Structure& s, const State& state) {
  double gap = INFINITY;
  for_each_pair(s, state, [&](const OrientedBox& a, const OrientedBox& b) {
    gap = std::min(gap, overlap(a, b) ? 0 : separation(a, b));
  });
  return gap;
}

bool are_deep(const Structure& s, const State& state) {
  bool deep = false;
  for_each_pair(s, state, [&](const OrientedBox& a, const OrientedBox& b) {
    deep = deep || overlap(a, b, s.size.thickness_mm / 2);
  });
  return deep;
}

/// Contact begins where the walls' boxes, cut along their hinges, meet, and not a step later.
TEST(AskedAngle, ContactIsFoundWhereWallsMeet) {
  const CellTuple unit{.A_in = {pi / 2, pi / 3, pi / 2, pi / 3}};
  for (const double thickness_mm : {0.05, 0.8, 2.0})
    for (const bool twists : {false, true}) {
      SCOPED_TRACE(::testing::Message() << thickness_mm << " mm, twists " << twists);
      const CellSize size{10, thickness_mm, 6};
      const Structure s = twists ? tiled(1, 1, unit, unit, size) : make_structure(rectangle(2, 2), size);
      double last = 0;
      int begun = 0;
      trace_equilibrium(driven(s, hinge_drive(s, {{0, 0}, Axis::x}, twists ? -0.85 : 0.85)), hinges, {},
                        [&](const EquilibriumStep& step, const State& state) {
                          if (step.contacts > 0 && begun++ == 0) {
                            EXPECT_LE(std::abs(step.theta - last), 1.2e-7);
                            EXPECT_LE(min_gap(s, state), 1e-6 * s.size.edge_mm);
                          }
                          if (step.contacts == 0) {
                            EXPECT_FALSE(are_deep(s, state)) << step.theta;
                          }
                          last = step.theta;
                        });
      EXPECT_GT(begun, 0);
    }
}

}  // namespace
}  // namespace kinetix::model
