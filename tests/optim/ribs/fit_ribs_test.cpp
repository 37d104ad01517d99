#include "optim/ribs/fit_ribs.hpp"

#include <gmock/gmock.h>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

RibsSpec ribs_of(double edge_mm, int ribs) {
  RibsSpec spec;
  spec.size = {edge_mm, 0.08 * edge_mm, 0.15 * edge_mm};
  spec.ribs = ribs;
  spec.clearance_mm = 0;
  return spec;
}

double rms_over_diagonal(const targets::RibbedSurface& surface, const RibsSpec& spec) {
  const RibsDesign design = fit_ribs(surface, spec, {});
  EXPECT_TRUE(design.collisions.empty());
  EXPECT_LE(hinge_gaps(design.fishbone.structure, design.state).max, 1e-12);
  EXPECT_EQ(design.layout.spine_and_ribs.ribs.size(), spec.ribs);
  return design.error.rms / surface.diagonal;
}

TEST(FitRibs, FollowsPatchesThatCurveBothWays) {
  constexpr double deg = radians_per_degree;
  EXPECT_LE(rms_over_diagonal(targets::ribbed_surface(targets::cap_patch(100, 60 * deg)), ribs_of(7, 8)),
            5e-4);
  EXPECT_LE(rms_over_diagonal(targets::ribbed_surface(targets::saddle_patch(100, 0.3)), ribs_of(7, 8)), 1e-3);
  EXPECT_LE(
      rms_over_diagonal(targets::ribbed_surface(targets::vase_patch(120, 50, 10, 60 * deg)), ribs_of(7, 8)),
      1e-3);
}

TEST(FitRibs, GoesOverClosedMeshes) {
  EXPECT_LE(rms_over_diagonal(targets::ribbed_surface(testing::ellipsoid({50, 50, 50})), ribs_of(7, 5)),
            1e-3);
  EXPECT_LE(rms_over_diagonal(targets::ribbed_surface(testing::ellipsoid({100, 30, 30})), ribs_of(7, 5)),
            4e-3);
}

TEST(FitRibs, IsTheSameAtEverySize) {
  const auto at = [](double scale) {
    return rms_over_diagonal(targets::ribbed_surface(testing::ellipsoid(scale * Vector3d(100, 60, 50))),
                             ribs_of(9 * scale, 4));
  };
  const double usual = at(1);
  EXPECT_LE(usual, 2e-3);
  EXPECT_NEAR(at(0.1), usual, 0.02 * usual);
  EXPECT_NEAR(at(25), usual, 0.02 * usual);
}

/// Around a cylinder a rib is a regular polygon. Its bodies are in the middle of the sides, its hinges at the corners.
/// Corners are at most edge^2 / (8 radius) farther out, and the fit shares that between both.
TEST(FitRibs, LooseRibsMissACylinderByPartOfACellsSagitta) {
  targets::SurfacePatch cylinder{"cylinder", {80, 40}, [](const Eigen::Vector2d& at) {
                                   const double z = std::sqrt(2500 - at.y() * at.y());
                                   targets::Height h{z, {0, -at.y() / z}};
                                   h.bending(1, 1) = -2500 / (z * z * z);
                                   return h;
                                 }};
  const targets::RibbedSurface surface = targets::ribbed_surface(cylinder);
  const LooseRibs ribs = fit_loose_ribs(surface, ribs_of(8, 6), {});
  EXPECT_EQ(ribs.pieces, 6);
  EXPECT_LE(ribs.rms, 0.5 * 8 * 8 / (8 * 50.0));
  EXPECT_GT(ribs.open, 0);
  EXPECT_LT(ribs.open, 1);
}

TEST(FitRibs, LooseRibsKeepTheLengthOfTheirSections) {
  const targets::RibbedSurface surface =
      targets::ribbed_surface(targets::cap_patch(100, 80 * radians_per_degree));
  const RibsSpec spec = ribs_of(8, 5);
  const LooseRibs ribs = fit_loose_ribs(surface, spec, {});
  const RibsLayout plan = plan_ribs(surface, spec);
  int cells = 0;
  for (const model::FishboneRib& rib : plan.spine_and_ribs.ribs) cells += rib.cells[0] + rib.cells[1] + 1;
  EXPECT_NEAR(ribs.open, open_area(cells, spec.size, plan.start.theta, surface.area), 0.02);
}

TEST(FitRibs, OpenAreaCountsTheSquaresOfFoldedCells) {
  EXPECT_NEAR(open_area(12, {10, 1, 2}, 60 * radians_per_degree, 1000), 1 - 12 * 25 / 1000.0, 1e-14);
}

TEST(FitRibs, RefusesMoreRibsThanRowsHold) {
  const targets::RibbedSurface surface =
      targets::ribbed_surface(targets::cap_patch(100, 60 * radians_per_degree));
  EXPECT_THROW(plan_ribs(surface, ribs_of(10, 12)), InvalidInput);
  EXPECT_THROW(plan_ribs(surface, ribs_of(100, 1)), InvalidInput);
}

}  // namespace
}  // namespace kinetix::optim
