#include "model/elastic/path/stable_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::model {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Structure twist_unit(double alpha) {
  const CellTuple unit{.A_in = {pi / 2, alpha, pi / 2, alpha}};
  return tiled(1, 1, unit, unit);
}

/// Hinges that hardly hold their turn: k_turn is 1e-10 of k_point edge^2.
const Elasticity loose{.k_turn = 1e-5};

StableStates searched(const Structure& s, const Elasticity& elasticity = loose,
                      double theta = 60 * radians_per_degree) {
  return find_stable_states(driven(s, search_drives(s, theta)), elasticity, {.path = without_contact()});
}

double lean(const State& state) {
  const Eigen::Vector3d up = state[0].R.col(2), other = state[1].R.col(2);
  return std::atan2(up.cross(other).norm(), up.dot(other));
}

TEST(StableStates, OfATwistUnitAreFlatAndTheTwistOfEquationSix) {
  double last = std::numeric_limits<double>::infinity();
  for (const double alpha : {30, 45, 60, 75, 85}) {
    SCOPED_TRACE(alpha);
    const Structure s = twist_unit(alpha * radians_per_degree);
    const StableStates found = searched(s);
    EXPECT_THAT(found.unresolved, IsEmpty());
    ASSERT_EQ(found.states.size(), 2u);
    EXPECT_EQ(found.states[0].energy, 0);
    EXPECT_EQ(aligned_distance(s, found.states[0].state, rest_state(s)).rms, 0);
    EXPECT_NEAR(lean(found.states[1].state), std::abs(pi - twist_angle(alpha * radians_per_degree)), 1e-6);
    EXPECT_NEAR(found.states[1].theta, -45 * radians_per_degree, 1e-6);
    EXPECT_LE(found.states[1].gaps.max, 1e-8);
    EXPECT_THAT(found.states[1].how, HasSubstr("released at a fold angle of -4"));

    ASSERT_EQ(found.barriers.size(), 1u);
    const EnergyBarrier& barrier = found.barriers[0];
    EXPECT_EQ(barrier.from, 0);
    EXPECT_EQ(barrier.to, 1);
    EXPECT_TRUE(barrier.load_vanishes);
    EXPECT_GT(barrier.energy, 1e4 * found.states[1].energy);
    EXPECT_LT(barrier.energy, last) << "the less the hinges lean, the lower";
    last = barrier.energy;
  }
}

/// Between -45 deg and flat; on the other side alpha and 180 deg - alpha change places.
TEST(StableStates, OfTheMirroredTwistUnitHaveTheSameBarrier) {
  const StableStates found = searched(twist_unit(60 * radians_per_degree)),
                     mirrored = searched(twist_unit(120 * radians_per_degree));
  ASSERT_EQ(mirrored.states.size(), 2u);
  EXPECT_NEAR(lean(mirrored.states[1].state), lean(found.states[1].state), 1e-7);
  EXPECT_NEAR(mirrored.barriers.at(0).energy, found.barriers.at(0).energy, 1e-6 * found.barriers[0].energy);
}

TEST(StableStates, TheBarrierIsTheTopOfAFinelySteppedPath) {
  const Structure s = twist_unit(60 * radians_per_degree);
  EquilibriumPathOptions fine = without_contact();
  fine.first_step = fine.longest_step = 2e-3;
  const EquilibriumPath path =
      trace_equilibrium(driven(s, search_drives(s, 45 * radians_per_degree)[1]), loose, fine);
  double top = 0;
  for (const EquilibriumStep& step : path.steps) top = std::max(top, step.energy);
  const double barrier = searched(s).barriers.at(0).energy;
  EXPECT_GE(barrier, top * (1 - 1e-12));
  EXPECT_NEAR(barrier, top, 1e-4 * top);
}

TEST(StableStates, OfStructuresThatMoveExactlyAreFlatAlone) {
  for (const Structure& s : {tiled(3, 3, {}, {}), bending_strip(), curling_sheet()}) {
    const StableStates found = searched(s);
    EXPECT_EQ(found.states.size(), 1u);
    EXPECT_THAT(found.barriers, IsEmpty());
    EXPECT_THAT(found.unresolved, IsEmpty());
  }
}

/// Plates keep the unit's rows straight, which takes more than a driven hinge. The state after their release is
/// the same.
TEST(StableStates, OfATwistUnitAreTheSameUnderPlatesBehindAHigherBarrier) {
  const Structure s = twist_unit(60 * radians_per_degree);
  const StableStates by_hinge = searched(s);
  const StableStates by_plates =
      find_stable_states(driven(s, std::vector<Drive>{plates_drive(Axis::y, -30 * radians_per_degree)}),
                         loose, {.path = without_contact()});
  ASSERT_EQ(by_plates.states.size(), 2u);
  EXPECT_THAT(by_plates.states[1].how, HasSubstr("released at a fold angle of -30 deg"));
  EXPECT_LE(aligned_distance(s, by_plates.states[1].state, by_hinge.states[1].state).rms, 1e-7);
  EXPECT_GT(by_plates.barriers.at(0).energy, by_hinge.barriers.at(0).energy);
  EXPECT_TRUE(by_plates.barriers[0].load_vanishes);
}

TEST(StableStates, OfAStripOfTwistingUnitsHaveEveryOtherUnitTwisted) {
  const Structure s = twisting_strip();
  const StableStates found =
      find_stable_states(driven(s, std::vector<Drive>{search_drives(s, 60 * radians_per_degree)[0]}), loose,
                         {.path = without_contact()});
  ASSERT_EQ(found.states.size(), 2u);
  EXPECT_NEAR(found.states[1].theta, 45 * radians_per_degree, 1e-5);
  EXPECT_LE(found.states[1].gaps.max, 1e-7);
  EXPECT_TRUE(found.barriers.at(0).load_vanishes);
}

TEST(StableStates, AReleaseThatDoesNotComeToRestSaysSo) {
  const Structure s = twist_unit(60 * radians_per_degree);
  const StableStates found = find_stable_states(driven(s, search_drives(s, 60 * radians_per_degree)), loose,
                                                {.path = without_contact(), .max_iterations = 1});
  EXPECT_EQ(found.states.size(), 1u);
  EXPECT_THAT(found.unresolved, ElementsAre(HasSubstr("no stable state after 2 iterations, force ")));
  EXPECT_THAT(found.barriers, IsEmpty());
}

}  // namespace
}  // namespace kinetix::model
