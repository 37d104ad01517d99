#include "model/assembly/assembly_motion.hpp"

#include <gtest/gtest.h>

#include "model/closure/closure.hpp"
#include "tests/support/rotating_squares.hpp"

namespace kinetix::model {
namespace {

Linkage squares(int columns, int rows) {
  const TileMake make{.scale_mm = 10, .thickness_mm = 0.5, .kerf_mm = 0.3};
  return linkage_of(assembly_of_tiles(testing::rotating_squares(columns, rows, 0.3), make));
}

TEST(AssemblyMotion, TurnsAllSquaresOfASheetAlike) {
  const Linkage sheet = squares(3, 2);
  const FirstMotion first = first_motion(sheet);
  const double turn = first.rate > 0 ? 0.4 : -0.4;
  const AssemblyMotion motion = follow_turn(sheet, first, first.fastest, turn);
  ASSERT_TRUE(motion.reached);
  EXPECT_LE(motion.gap, 1e-9);
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h)
    EXPECT_NEAR(std::abs(hinge_turn(sheet, motion.states.back(), h)), 0.4, 1e-9) << h;
}

// Only the first motion determines where the other hinges of a chain go.
TEST(AssemblyMotion, LeavesRestAlongTheFirstMotion) {
  const Linkage chain = squares(4, 1);
  const FirstMotion first = first_motion(chain);
  const double step = AssemblyMotionOptions{}.step;
  const AssemblyMotion motion = follow_turn(chain, first, 0, step);
  ASSERT_TRUE(motion.reached);
  ASSERT_EQ(motion.states.size(), 2u);
  const auto rate = [&](int h) {
    const RestHinge& hinge = chain.hinges[h];
    return hinge.axis.dot(first.twists[hinge.upper].omega - first.twists[hinge.lower].omega);
  };
  for (int h = 0; h < static_cast<int>(chain.hinges.size()); ++h)
    EXPECT_NEAR(hinge_turn(chain, motion.states.back(), h), step * rate(h) / rate(0), step * step) << h;
}

}  // namespace
}  // namespace kinetix::model
