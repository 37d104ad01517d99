#include "model/elastic/balance_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix {
namespace {

using testing::plates_drive;
using Outcome = BalanceComparison::Outcome;

constexpr double theta = 0.4, tolerance = 1e-2;

class Comparison : public ::testing::Test {
 protected:
  State balance(double at) const { return follow_load(sheet, {}, plates_drive(Axis::y, at)).state; }

  const Structure sheet = testing::alternating(3, 3, testing::scaling_unit, testing::scaling_unit);
  const BalanceScene scene{sheet, {}, plates_drive(Axis::y, theta), true, true};
};

TEST_F(Comparison, OfABalanceWithItselfAgrees) {
  const BalanceComparison same = compare_balances(scene, balance(theta), balance(theta), tolerance);
  EXPECT_EQ(same.outcome, Outcome::agrees);
  EXPECT_LE(same.from_balance.rms, 1e-9);
  EXPECT_NEAR(same.energy, same.reference_energy, 1e-9 * same.energy);
}

TEST_F(Comparison, OfTheTwoSignsOfThetaSaysThatBothAreBalances) {
  const BalanceComparison other = compare_balances(scene, balance(-theta), balance(theta), tolerance);
  EXPECT_EQ(other.outcome, Outcome::another_branch);
  EXPECT_GT(other.distance.rms, tolerance);
  EXPECT_LE(other.from_balance.rms, 1e-9);
  EXPECT_NEAR(other.energy, other.reference_energy, 1e-6 * other.energy);
  EXPECT_THAT(other.why, ::testing::HasSubstr("another branch"));
}

TEST_F(Comparison, OfAStateThatIsNoBalanceDisagrees) {
  const BalanceComparison near = compare_balances(scene, balance(0.3), balance(theta), tolerance);
  EXPECT_EQ(near.outcome, Outcome::disagrees);
  EXPECT_GT(near.from_balance.rms, tolerance);
  const BalanceComparison flat = compare_balances(scene, rest_state(sheet), balance(theta), tolerance);
  EXPECT_EQ(flat.outcome, Outcome::disagrees);
}

}  // namespace
}  // namespace kinetix
