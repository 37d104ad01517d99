#include "model/lattice/nearest_design.hpp"

#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::testing {
namespace {

using model::Lattice;

Lattice strip_of(const std::vector<double>& tilts, int rows) {
  auto design = model::ExactDesign<double>::basic(static_cast<int>(tilts.size()), rows);
  design.beta = tilts;
  return sheet_of(design, {10, 0.8, 6});
}

TEST(NearestDesign, IsTheSheetItselfWhereItMoves) {
  const auto nearest = nearest_design(strip_of({0.3, -0.3, 0.2}, 2));
  ASSERT_TRUE(nearest);
  EXPECT_TRUE(nearest->changed.empty());
}

TEST(NearestDesign, TakesBackTheOneTiltThatBreaksTheRule) {
  const Lattice sheet = strip_of({0.3, -0.3, 0.2}, 2);
  for (int h = 0; h < sheet.hinges(); ++h) {
    SCOPED_TRACE(h);
    Lattice broken = sheet;
    broken.hinge(h).beta += 0.1;
    ASSERT_FALSE(exact_motion(broken));
    const auto nearest = nearest_design(broken);
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->changed, std::vector<int>{h});
    EXPECT_NEAR(nearest->sheet.hinge(h).beta, sheet.hinge(h).beta, 1e-15);
  }
}

TEST(NearestDesign, TakesBackTheOneFractionThatBreaksTheRuleOfAnUprightCrease) {
  auto design = model::ExactDesign<double>::basic(3, 3);
  design.beta = {0.3, 0, 0.2};
  design.t[1] = 0.4;
  const Lattice sheet = sheet_of(design, {10, 0.8, 6});
  ASSERT_TRUE(exact_motion(sheet));
  for (int h = 0; h < sheet.hinges(); ++h) {
    const model::Wall& wall = sheet.squares()->hinges[h].wall;
    if (wall.axis != model::Axis::x || wall.from.i != 1) continue;
    SCOPED_TRACE(h);
    Lattice broken = sheet;
    broken.hinge(h).t += 0.05;
    ASSERT_FALSE(exact_motion(broken));
    const auto nearest = nearest_design(broken);
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->changed, std::vector<int>{h});
    EXPECT_NEAR(nearest->sheet.hinge(h).t, sheet.hinge(h).t, 1e-15);
  }
}

TEST(NearestDesign, MovesUprightHingesAsLittleAsTheCellsAsk) {
  Lattice broken = strip_of({0, 0, 0}, 3);
  broken.hinge(0).t = 0.6;
  const auto nearest = nearest_design(broken);
  ASSERT_TRUE(nearest);
  EXPECT_TRUE(exact_motion(nearest->sheet));
  double change = 0;
  for (int h = 0; h < broken.hinges(); ++h)
    change += std::pow(nearest->sheet.hinge(h).t - broken.hinge(h).t, 2);
  EXPECT_LT(change, 0.01);
  EXPECT_FALSE(nearest->changed.empty());
}

TEST(NearestDesign, LeavesCreasesAlongOneDirectionWhereTheyCross) {
  Lattice crossed = strip_of({0.3, -0.3, 0.3}, 3);
  for (int h = 0; h < crossed.hinges(); ++h)
    if (crossed.squares()->hinges[h].wall.axis == model::Axis::y) crossed.hinge(h).beta = 0.05;
  ASSERT_FALSE(exact_motion(crossed));
  const auto nearest = nearest_design(crossed);
  ASSERT_TRUE(nearest);
  for (int h = 0; h < crossed.hinges(); ++h) {
    if (crossed.squares()->hinges[h].wall.axis == model::Axis::x) {
      EXPECT_EQ(nearest->sheet.hinge(h).beta, crossed.hinge(h).beta);
    }
  }
}

}  // namespace
}  // namespace kinetix::testing
