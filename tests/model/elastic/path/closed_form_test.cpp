#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/closure/closure.hpp"
#include "model/elastic/path/closed_form.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/sodalite_arms.hpp"

namespace kinetix::model {
namespace {

using namespace testing;

constexpr double driven_theta = 0.3;  // rad, of the drives below

class ClosedFormOfASheet : public ::testing::Test {
 protected:
  ElasticSystem under(const Drive& drive) const {
    return {sheet_, {}, drive_on(sheet_, drive), false, false};
  }

  const Structure sheet_ = make_structure(rectangle(3, 2), {});
  const ExactMotion exact_ = exact_motion(sheet_);
};

TEST_F(ClosedFormOfASheet, IsWhereItsDriveHoldsIt) {
  for (const Drive& drive : {plates_drive(Axis::y, driven_theta), plates_drive(Axis::x, -driven_theta),
                             hinge_drive(sheet_, {{0, 0}, Axis::y}, driven_theta)}) {
    const ElasticSystem system = under(drive);
    const State state = *ClosedForm(system, exact_).at(driven_theta);
    State placed = state;
    system.place(driven_theta, placed);
    EXPECT_LE(aligned_distance(sheet_, state, fold(classify(sheet_), sheet_, driven_theta)).rms, 1e-12);
    for (std::size_t b = 0; b < state.size(); ++b) EXPECT_EQ(state[b].p, placed[b].p);
  }
}

TEST_F(ClosedFormOfASheet, IsNearUpToAHundredthOfARadian) {
  const ElasticSystem system = under(plates_drive(Axis::y, driven_theta));
  const ClosedForm closed_form(system, exact_);
  const State state = *closed_form.at(driven_theta);
  EXPECT_TRUE(closed_form.is_near(state, driven_theta + 0.004));
  EXPECT_NEAR(*closed_form.distance(state, driven_theta + 0.004), 0.008, 1e-12) << "hinges turn by 2 theta";
  EXPECT_FALSE(closed_form.is_near(state, driven_theta + 0.006));
}

TEST_F(ClosedFormOfASheet, OfTheOtherSideIsMirroredBetweenPlatesAlone) {
  const ElasticSystem plates = under(plates_drive(Axis::y, driven_theta));
  const ElasticSystem hinge = under(hinge_drive(sheet_, {{0, 0}, Axis::y}, driven_theta));
  const ClosedForm between_plates(plates, exact_), by_hinge(hinge, exact_);
  EXPECT_TRUE(between_plates.is_mirrored(*between_plates.at(-driven_theta), driven_theta));
  EXPECT_FALSE(between_plates.is_mirrored(*between_plates.at(driven_theta), driven_theta));
  EXPECT_FALSE(by_hinge.is_mirrored(*by_hinge.at(-driven_theta), driven_theta));
}

TEST_F(ClosedFormOfASheet, IsNoneWhereNoneIsKnown) {
  const ElasticSystem system = under(plates_drive(Axis::y, driven_theta));
  const ExactMotion none;
  const ClosedForm closed_form(system, none);
  EXPECT_FALSE(closed_form.at(driven_theta));
  EXPECT_FALSE(closed_form.is_near(rest_state(sheet_), 0));
  EXPECT_FALSE(closed_form.is_mirrored(rest_state(sheet_), 0));
}

using namespace testing;
using ::testing::HasSubstr;
using testing::hinge_drive;
using Kind = PathEvent::Kind;
using Stop = EquilibriumPath::Stop;

constexpr double deg = radians_per_degree;  // rad, so that angles of cases read in degrees

double turn_difference(const DrivenLinkage& driven, const EquilibriumPath& path) {
  return turn_distance(driven.linkage, path.state, driven.exact.at(path.theta));
}

// ---- Panels whose closed form reaches a place where a second motion begins ----

struct ClosedBoundary {
  const char* name;
  const PlanarLattice* lattice;
  double branching;  ///< theta there, rad: where the second singular value of the closure equations is least
};

std::ostream& operator<<(std::ostream& out, const ClosedBoundary& panel) { return out << panel.name; }

class PanelOfClosedRim : public ::testing::TestWithParam<ClosedBoundary> {
 protected:
  DrivenLinkage by_one_wall(double theta) const {
    return {panel_, hinge_drive(panel_, 0, turn_at_theta(panel_.senses[panel_.graph.edges[0].from], theta)),
            exact_motion(panel_)};
  }
  DrivenLinkage by_plates(double theta) const {
    const Axis axis = GetParam().lattice == &octagon_lattice ? Axis::y : plates_axis();
    return {panel_, plate_drive(panel_, axis, 1 - std::cos(theta), 1), exact_motion(panel_)};
  }

  const PlanarStructure panel_ =
      make_planar_structure({GetParam().lattice, lattice_cells(3, 3), 0, true}, {});

 private:
  /// Returns the axis along which plates find two lines to grip.
  Axis plates_axis() const { return GetParam().lattice == &brick_lattice ? Axis::y : Axis::x; }
};

TEST_P(PanelOfClosedRim, IsToldToLeaveItsClosedFormByOneWall) {
  const DrivenLinkage driven = by_one_wall(30 * deg);
  const EquilibriumPath path = trace_equilibrium(driven, {}, without_contact());
  const PathEvent* left = first_event(path, Kind::departure);
  ASSERT_TRUE(left) << path.why;
  EXPECT_THAT(left->what, HasSubstr("left the analytic motion"));
  EXPECT_THAT(left->what, HasSubstr("less energy; a second motion begins near there"));
  EXPECT_LT(left->at.theta, GetParam().branching + 1 * deg);
  EXPECT_GT(left->at.theta, GetParam().branching - 10 * deg);
  EXPECT_EQ(path.off_closed_form_since, left->at.theta);
  EXPECT_THAT(path.why, HasSubstr("; off the analytic motion since "));
  EXPECT_GT(turn_difference(driven, path), 0.1);
}

/// Only the turning springs resist the second motion. The path shows no other sign that it is taken.
TEST_P(PanelOfClosedRim, LeavesItWithoutTurningUnstable) {
  const EquilibriumPath path = trace_equilibrium(by_one_wall(30 * deg), {}, without_contact());
  for (const EquilibriumStep& step : path.steps) EXPECT_TRUE(step.stable) << to_degrees(step.theta);
  for (const PathEvent& event : path.events) EXPECT_EQ(event.kind, Kind::departure) << event.what;
}

TEST_P(PanelOfClosedRim, StaysOnItBeforeASecondMotionBegins) {
  const EquilibriumPath path = trace_equilibrium(by_one_wall(5 * deg), {}, without_contact());
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  EXPECT_TRUE(path.events.empty()) << path.events.front().what;
}

/// Octagons do so only where hinges turn more softly than the default ones.
TEST_P(PanelOfClosedRim, StaysOnItBetweenPlates) {
  const DrivenLinkage driven = by_plates(30 * deg);
  const EquilibriumPath path = trace_equilibrium(driven, {.k_turn = 1e-3}, without_contact());
  EXPECT_EQ(path.stop, Stop::reached) << path.why;
  EXPECT_FALSE(first_event(path, Kind::departure));
  EXPECT_TRUE(std::isnan(path.off_closed_form_since));
  EXPECT_LE(turn_difference(driven, path), 0.1);
}

/// However stiff its hinges are, and by plates under which it folds.
TEST_P(PanelOfClosedRim, IsNeverOffItsClosedFormUntold) {
  const auto is_reported = [](const DrivenLinkage& driven, double k_turn) {
    const EquilibriumPath path = trace_equilibrium(driven, {.k_turn = k_turn}, without_contact());
    return turn_difference(driven, path) <= 0.1 || path.off_closed_form;
  };
  for (const double k_turn : {10.0, 0.1, 1e-3, 1e-4}) {
    EXPECT_TRUE(is_reported(by_one_wall(30 * deg), k_turn));
    EXPECT_TRUE(is_reported(by_plates(30 * deg), k_turn));
  }
}

TEST_P(PanelOfClosedRim, OfHingesThatGiveWayLeavesItForThese) {
  const EquilibriumPath path = trace_equilibrium(by_one_wall(30 * deg), {.k_turn = 100}, without_contact());
  const PathEvent* left = first_event(path, Kind::departure);
  ASSERT_TRUE(left);
  EXPECT_LT(left->at.theta, 8 * deg);
  EXPECT_THAT(left->what, HasSubstr("the hinges are too soft to hold it"));
}

INSTANTIATE_TEST_SUITE_P(Floppy, PanelOfClosedRim,
                         ::testing::Values(ClosedBoundary{"honeycomb", &honeycomb_lattice, 15.7 * deg},
                                           ClosedBoundary{"bricks", &brick_lattice, 22.7 * deg},
                                           ClosedBoundary{"octagons", &octagon_lattice, 9.3 * deg}),
                         ::testing::PrintToStringParamName());

TEST(Departure, OfABlockIsFromTheFlatStateWhereSeveralMotionsBegin) {
  const SodaliteStructure block = block_with_arms({1, 1, 1}, {0.8, 0.7, 0.6, 0.5, 0.75, 0.65}, {10, 0.4, 1});
  const DrivenLinkage driven{block, hinge_drive(block, 0, turn_at_theta(1, 20 * deg)), exact_motion(block)};
  const EquilibriumPath path = trace_equilibrium(driven, {.k_turn = 10}, without_contact());
  const PathEvent* left = first_event(path, Kind::departure);
  ASSERT_TRUE(left) << path.why;
  EXPECT_THAT(left->what, HasSubstr("one of several motions that begin in the flat state"));
}

// ---- Structures that keep to their closed form ----

struct Keeping {
  const char* name;
  Structure structure;
};

std::ostream& operator<<(std::ostream& out, const Keeping& keeping) { return out << keeping.name; }

class KeepingStructure : public ::testing::TestWithParam<Keeping> {};

TEST_P(KeepingStructure, IsNotToldToLeaveItsClosedForm) {
  const Structure& s = GetParam().structure;
  const Wall& middle = s.hinges[s.hinges.size() / 2].wall;
  for (const double theta : {20 * deg, -20 * deg})
    for (const Drive& drive : {drive_to(s, theta), hinge_drive(s, middle, theta)}) {
      const EquilibriumPath path = trace_equilibrium(driven(s, drive), {}, without_contact());
      EXPECT_EQ(path.stop, Stop::reached) << path.why;
      const PathEvent* left = first_event(path, Kind::departure);
      EXPECT_FALSE(left) << left->what;
      EXPECT_TRUE(std::isnan(path.off_closed_form_since));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Ordinary, KeepingStructure,
    ::testing::Values(Keeping{"basic_sheet", make_structure(rectangle(6, 4), {})},
                      Keeping{"bending_strip", bending_strip()}, Keeping{"bending_sheet", bending_sheet()},
                      Keeping{"curling_strip", curling_strip()}, Keeping{"twisting_strip", twisting_strip()},
                      Keeping{"letter_T", letter_panel(0.8)}, Keeping{"shearing_grid", uncrossable_grid()}),
    ::testing::PrintToStringParamName());

/// Walls that press on each other take a sheet off its closed form. Contact and lock events report that.
TEST(Departure, IsNoneWhereWallsMeetOnTheClosedForm) {
  const Structure s = uncrossable_grid();
  const EquilibriumPath path =
      trace_equilibrium(driven(s, hinge_drive(s, {{0, 0}, Axis::y}, 60 * deg)), {.k_turn = 1e-3}, {});
  EXPECT_TRUE(first_event(path, Kind::contact));
  EXPECT_FALSE(first_event(path, Kind::departure));
}

// ---- The watch alone ----

class WatchOfASheet : public ::testing::Test {
 protected:
  /// A state of the closed form `off`, rad of a hinge, beside that at theta.
  std::optional<double> see(BranchingDetector& watch, double off, bool followed_closed_form = false) const {
    return watch.see(*closed_form_.at(theta_ + off / 2), theta_, followed_closed_form);
  }

  static constexpr double theta_ = 0.3;  // rad, of the drive: hinges turn by six times what counts as far
  const Structure sheet_ = make_structure(rectangle(3, 2), {});
  const ExactMotion exact_ = exact_motion(sheet_);
  const ElasticSystem system_{
      sheet_, {}, drive_on(sheet_, hinge_drive(sheet_, {{0, 0}, Axis::y}, theta_)), false, false};
  const ClosedForm closed_form_{system_, exact_};
};

TEST_F(WatchOfASheet, SeesOnceThatAPathIsFurtherThanATenthOfARadian) {
  BranchingDetector watch(system_, closed_form_, true);
  EXPECT_FALSE(see(watch, 0.09));
  EXPECT_TRUE(watch.is_back());
  EXPECT_NEAR(*see(watch, 0.11), 0.11, 1e-9);
  EXPECT_FALSE(watch.is_back());
  EXPECT_FALSE(see(watch, 0.2));
}

TEST_F(WatchOfASheet, SeesAPathComeBack) {
  BranchingDetector watch(system_, closed_form_, true);
  EXPECT_TRUE(see(watch, 0.2));
  EXPECT_FALSE(see(watch, 0.05));
  EXPECT_FALSE(watch.is_back());
  EXPECT_FALSE(see(watch, 0.005));
  EXPECT_TRUE(watch.is_back());
  EXPECT_TRUE(see(watch, 0.2));
}

TEST_F(WatchOfASheet, SeesNothingBeforeAPathCameAlongTheClosedForm) {
  BranchingDetector watch(system_, closed_form_, false);
  EXPECT_FALSE(see(watch, 0.2));
  EXPECT_FALSE(see(watch, 0, true));
  EXPECT_TRUE(see(watch, 0.2));
}

}  // namespace
}  // namespace kinetix::model
