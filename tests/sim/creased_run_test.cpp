#include <gtest/gtest.h>

#include "model/lattice/planar/planar_motion.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/miura.hpp"

namespace kinetix::sim {
namespace {

/// Distance of the settled run from the closed form at theta, cell edges.
double from_crease_law(const model::PlanarStructure& s, double theta, PhysicsOptions options) {
  options.joint_stiffness = 1e8;
  const PhysicsResult run = run_compression(s, drive_to(s, theta), options);
  EXPECT_EQ(run.status, PhysicsResult::Status::settled) << run.why;
  return aligned_distance(s, run.state, exact_motion(s).at(theta)).rms;
}

TEST(CreasedRun, FoldsAMiuraSheetOfHexagonsToItsClosedForm) {
  EXPECT_LE(from_crease_law(testing::miura_of_hexagons(4, 4, pi / 3, 0.9), 0.5, {}), 1e-6);
}

}  // namespace
}  // namespace kinetix::sim
