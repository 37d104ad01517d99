#include <gtest/gtest.h>
#include <cmath>

#include "sim/physics_run.hpp"
#include "tests/sim/overlap.hpp"
#include "tests/sim/runs.hpp"

namespace kinetix::sim {
namespace {

using testing::expect_exact;
using testing::physics_without_contact;
using testing::run;
using testing::strip;
using testing::structure_of;
using Status = PhysicsResult::Status;

TEST(Contact, StopsBasicCellsWhereTheirWallsMeet) {
  auto design = model::ExactDesign<double>::basic(3, 3);
  const model::CellSize size;
  const double limit = std::atan(1 - size.thickness_mm / size.edge_mm);
  for (const double sign : {1.0, -1.0}) {
    design.theta = sign * (limit - 0.002);
    expect_exact(design, run(design));
    design.theta = sign * (limit + 0.01);
    const PhysicsResult stopped = run(design);
    EXPECT_EQ(stopped.status, Status::blocked) << stopped.why;
    EXPECT_NE(stopped.why.find("touch"), std::string::npos) << stopped.why;
    EXPECT_NEAR(std::abs(std::asin(stopped.state[0].R(1, 0))), limit, 0.005);
    EXPECT_LE(stopped.gaps.max, 5e-4) << "the structure stays whole";
    expect_exact(design, run(design, physics_without_contact()));
  }
}

TEST(Contact, NeverLetsAFastDriveThroughTheLimit) {
  auto design = model::ExactDesign<double>::basic(3, 3);
  design.theta = 1.2;
  EXPECT_EQ(run(design).status, Status::blocked);
}

void expect_random_strips_to_block_at_overlaps(int strips) {
  constexpr unsigned seed = 30;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  int blocked = 0;
  for (int trial = 0; trial < strips; ++trial) {
    std::vector<double> tilts(5);
    for (double& tilt : tilts) tilt = 0.7 * unit(random);
    const auto design = strip(tilts, 0.55 + 0.15 * unit(random));
    const model::Structure structure = structure_of(design);
    const double overlap = testing::deepest_overlap(structure, fold(design, structure));
    if (std::abs(overlap) < 0.01) continue;
    const PhysicsResult result = run(design);
    EXPECT_EQ(result.status, overlap > 0 ? Status::blocked : Status::settled)
        << "seed " << seed << ", trial " << trial << ", overlap " << overlap << ": " << result.why;
    blocked += overlap > 0;
  }
  EXPECT_GE(blocked, strips / 6);
  EXPECT_LE(blocked, strips * 5 / 6);
}

TEST(Contact, BlocksARandomStripExactlyWhereItsHalfWallsWouldOverlap) {
  expect_random_strips_to_block_at_overlaps(8);
}

TEST(ContactSoak, BlocksARandomStripExactlyWhereItsHalfWallsWouldOverlap) {
  expect_random_strips_to_block_at_overlaps(24);
}

TEST(Contact, KeepsTheEndsOfAStripThatClosesARingApart) {
  const auto design = strip(testing::curl(24, 0.3), 0.6);
  const model::Structure structure = structure_of(design);
  ASSERT_GT(testing::deepest_overlap(structure, fold(design, structure)), 0.01);
  const PhysicsResult result = run(design);
  EXPECT_EQ(result.status, Status::blocked) << result.why;
}

}  // namespace
}  // namespace kinetix::sim
