#include <gtest/gtest.h>

#include "model/base/geometry.hpp"
#include "tests/support/played_twist_unit.hpp"

/// Flip of the paper's twist unit with clearance in its pins.
namespace kinetix::model {
namespace {

using testing::flip_barrier;

/// Compares the energy of stiff pins with geometry alone, which shares no code with it.
TEST(PlayedFlip, HasNoBarrierFromThePlayOnThatItsGeometryNeeds) {
  for (const double degrees : {60.0, 75.0, 80.0}) {
    SCOPED_TRACE(degrees);
    const double alpha = degrees * radians_per_degree;
    const testing::LeastGap::Bracket needed = testing::flip_play(alpha);
    EXPECT_LE(needed.upper, 1.0011 * needed.lower);
    const double gone = testing::vanishing_play(alpha, 0.4 * needed.upper, 0.7 * needed.upper);
    EXPECT_NEAR(gone / needed.upper, 1, 0.01);
    // The remaining energy is that of the turning springs, 5e-4 N mm, and of the small stiffness within the clearance.
    EXPECT_LE(flip_barrier(alpha, 1.2 * needed.upper), 1e-3);
  }
}

TEST(PlayedFlip, HasABarrierThatFallsWithPlayAndGrowsWithStiffness) {
  const double alpha = 75 * radians_per_degree;
  double before = INFINITY;
  for (const double play : {0.0, 0.02, 0.05, 0.08, 0.12}) {
    const double barrier = flip_barrier(alpha, play);
    EXPECT_LT(barrier, before);
    EXPECT_NEAR(flip_barrier(alpha, play, 100) / barrier, 100, 2) << play;
    before = barrier;
  }
}

}  // namespace
}  // namespace kinetix::model
