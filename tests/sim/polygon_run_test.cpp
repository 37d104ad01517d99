#include <gtest/gtest.h>

#include "sim/compression_run.hpp"
#include "tests/support/polygons.hpp"

namespace kinetix::sim {
namespace {

TEST(PolygonRun, ARhombusThatNoLatticeMadeSettlesInItsClosedForm) {
  const double theta = 0.3;
  const model::DrivenLinkage scene = testing::driven(testing::rhombus(1.2, 0.2, -0.3), theta);
  const PhysicsResult result = run_compression(scene.linkage, scene.drive);
  ASSERT_EQ(result.status, PhysicsResult::Status::settled) << result.why;
  EXPECT_LE(aligned_distance(scene.linkage, result.state, scene.exact.at(theta)).rms, 1e-6);
}

}  // namespace
}  // namespace kinetix::sim
