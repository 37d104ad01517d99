#include "model/elastic/equilibrium_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::model {
namespace {

using testing::plates_drive;
using Outcome = EquilibriumComparison::Outcome;

// Theta in rad, half way to where the walls close the cells. Distance in cell edges up to which two states agree.
constexpr double compared_theta = 0.4, tolerance = 1e-2;

class Comparison : public ::testing::Test {
 protected:
  State equilibrium(double at) const {
    return trace_equilibrium(driven(sheet, plates_drive(Axis::y, at)), {}).state;
  }

  const Structure sheet = testing::alternating(3, 3, testing::scaling_unit, testing::scaling_unit);
  const EquilibriumScene scene{sheet, {}, drive_on(sheet, plates_drive(Axis::y, compared_theta)), true, true};
};

TEST_F(Comparison, OfAnEquilibriumWithItselfAgrees) {
  const EquilibriumComparison same =
      compare_equilibria(scene, equilibrium(compared_theta), equilibrium(compared_theta), tolerance);
  EXPECT_EQ(same.outcome, Outcome::agrees);
  EXPECT_LE(same.from_equilibrium.rms, 1e-9);
  EXPECT_NEAR(same.energy, same.reference_energy, 1e-9 * same.energy);
}

TEST_F(Comparison, OfTheTwoSignsOfThetaSaysThatBothAreEquilibria) {
  const EquilibriumComparison other =
      compare_equilibria(scene, equilibrium(-compared_theta), equilibrium(compared_theta), tolerance);
  EXPECT_EQ(other.outcome, Outcome::another_branch);
  EXPECT_GT(other.distance.rms, tolerance);
  EXPECT_LE(other.from_equilibrium.rms, 1e-9);
  EXPECT_NEAR(other.energy, other.reference_energy, 1e-6 * other.energy);
  EXPECT_THAT(other.why, ::testing::HasSubstr("another branch"));
}

TEST_F(Comparison, OfAStateThatIsNoEquilibriumDisagrees) {
  const EquilibriumComparison near =
      compare_equilibria(scene, equilibrium(0.3), equilibrium(compared_theta), tolerance);
  EXPECT_EQ(near.outcome, Outcome::disagrees);
  EXPECT_GT(near.from_equilibrium.rms, tolerance);
  const EquilibriumComparison flat =
      compare_equilibria(scene, rest_state(sheet), equilibrium(compared_theta), tolerance);
  EXPECT_EQ(flat.outcome, Outcome::disagrees);
}

}  // namespace
}  // namespace kinetix::model
