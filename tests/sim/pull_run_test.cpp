#include "sim/pull_run.hpp"

#include <gtest/gtest.h>

#include "model/assembly/tiles.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/support/rotating_squares.hpp"

namespace kinetix::sim {
namespace {

using testing::rotating_squares;

/// Tiles on their way to a target, and what they collide with.
struct PulledTiles {
  model::Linkage linkage;
  model::Pull pull;
  ContactParts parts;
};

PulledTiles pulled(const model::TileSheet& sheet) {
  const model::TileMake make{.scale_mm = 10, .thickness_mm = 0.5, .kerf_mm = 0.3};
  const model::Assembly assembly = assembly_of_tiles(sheet, make);
  PulledTiles out{linkage_of(assembly), {}, {}};
  out.pull = aligned_pull(out.linkage, {target_of_tiles(sheet, assembly, make.scale_mm).poses});
  for (const model::AssemblyBody& body : assembly.bodies) {
    std::vector<Eigen::Vector3d> corners = body.solid.points;
    for (Eigen::Vector3d& c : corners) c -= body.position;
    out.parts.of_body.push_back({corners});
  }
  return out;
}

PhysicsOptions usual() {
  PhysicsOptions options;
  options.step_s = 0.01;
  options.joint_stiffness = 1e8;
  return options;
}

double apart(const PulledTiles& tiles, const PhysicsResult& physics) {
  const model::Deployment closed = deploy(tiles.linkage, tiles.pull);
  EXPECT_TRUE(closed.reached);
  return aligned_distance(tiles.linkage, physics.state, closed.states.back()).max;
}

TEST(PullRun, EndsInTheNearestClosedState) {
  const PulledTiles tiles = pulled(rotating_squares(5, 4, 0.7));
  const PhysicsResult physics = run_pull(tiles.linkage, tiles.pull, usual(), tiles.parts);
  ASSERT_EQ(physics.status, PhysicsResult::Status::settled) << physics.why;
  EXPECT_LT(physics.gaps.max, 1e-6);
  EXPECT_LT(apart(tiles, physics), 1e-6);
}

/// Springs and the method of multipliers agree on one of many closed states. Tiles are on balls, one of them pulled
/// away.
TEST(PullRun, OfBallsThatCannotReachTheirTargetEndsThereToo) {
  model::TileSheet sheet = rotating_squares(4, 3, 0.6);
  for (model::TileJoint& joint : sheet.joints) joint.both_faces = false;
  for (auto& tile : sheet.target)
    for (Eigen::Vector3d& c : tile) c.z() = 0.05 * c.x() * c.x();
  for (Eigen::Vector3d& c : sheet.target[5]) c += Eigen::Vector3d(0.2, -0.1, 0.3);
  const PulledTiles tiles = pulled(sheet);
  PhysicsOptions options = usual();
  options.settle_seconds = 10;
  const PhysicsResult physics = run_pull(tiles.linkage, tiles.pull, options, tiles.parts);
  ASSERT_EQ(physics.status, PhysicsResult::Status::settled) << physics.why;
  EXPECT_LT(apart(tiles, physics), 1e-5);
}

TEST(PullRun, StopsWhereTilesMeet) {
  const PulledTiles tiles =
      pulled(rotating_squares(4, 4, -0.5));  // each square would have to go through its neighbours
  const PhysicsResult physics = run_pull(tiles.linkage, tiles.pull, usual(), tiles.parts);
  EXPECT_TRUE(physics.contact.touches()) << physics.why;
  EXPECT_LT(physics.contact.depth, 2e-3);
  EXPECT_GT(apart(tiles, physics), 0.1);
}

TEST(PullRun, RefusesWhatItCannotPull) {
  const PulledTiles tiles = pulled(rotating_squares(2, 2, 0.5));
  PhysicsOptions options = usual();
  options.elastic = model::Stiffness{};
  EXPECT_THROW(run_pull(tiles.linkage, tiles.pull, options, tiles.parts), InvalidInput);
}

}  // namespace
}  // namespace kinetix::sim
