#include <gtest/gtest.h>

#include "model/lattice/planar/closed_boundary.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/planar_graphs.hpp"
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

TEST(CreasedRun, HexagonsAndBricksFoldByTheLawOfCreases) {
  constexpr double theta = 0.2;
  for (const model::PlanarLattice* lattice : {&model::honeycomb_lattice, &model::brick_lattice}) {
    const testing::Creased c = testing::creased(closed_boundary(lattice_graph(*lattice, 3, 3)));
    const PhysicsResult result = run_compression(c.structure, drive_to(c.structure, theta));
    ASSERT_EQ(result.status, PhysicsResult::Status::settled) << lattice->name << ": " << result.why;
    EXPECT_LE(testing::from_folded(c, result.state, theta), 1e-6) << lattice->name;
  }
}

}  // namespace
}  // namespace kinetix::sim
