#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "optim/ribs/fit_ribs.hpp"
#include "targets/helmet/head.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/targets/heads.hpp"
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

using Eigen::VectorXd;

const Vector3d half_axes(76, 98, 100);  // mm, of an ellipsoid about as wide and long as a head

targets::MeshDistance head() { return {testing::ellipsoid(half_axes, 120, 60), Vector3d(0, 0, 0)}; }

RibsSpec spec(int ribs = 8) {
  RibsSpec w;
  w.size = {6, 0.6, 4};
  w.ribs = ribs;
  w.clearance_mm = 5;
  w.coverage_mm = 90;
  return w;
}

TEST(RibsProblem, DerivativesAgreeWithCentralDifferences) {
  const targets::MeshDistance mesh = head();
  RibsSpec w = spec(3);
  w.size = {20, 2, 10};
  const RibsLayout layout = plan_helmet(mesh, {0, 0, 100}, w);
  const model::Fishbone fishbone = make_fishbone(layout.spine_and_ribs, w.size);
  const RibsProblem problem(fishbone, {&mesh, 5, layout.rim_z, 0}, w.tilt, w.theta);
  constexpr unsigned seed = 17;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  VectorXd x = problem.pack(layout.start);
  for (double& v : x) v += 0.05 * unit(random);
  std::vector<ResidualBlock> blocks;
  const auto residual = [&](const VectorXd& at) {
    problem.evaluate(at, true, blocks);
    return stacked(problem, blocks).r;
  };
  residual(x);
  testing::expect_jacobian(residual, x, stacked(problem, blocks).J, 1e-5, 1e-5);
}

TEST(FitHelmet, KeepsTheClearanceFromAnEllipsoid) {
  const targets::MeshDistance mesh = head();
  const RibsDesign design = fit_helmet(mesh, {0, 0, 100}, spec(), {});
  EXPECT_LE(design.error.rms, 0.1);
  EXPECT_LE(design.error.max, 0.3);
  for (const double rib : design.error.of_ribs) EXPECT_LE(rib, 0.2);
  EXPECT_LE(hinge_gaps(design.fishbone.structure, design.state).max, 1e-12);
  EXPECT_EQ(classify(design.fishbone.structure).family, model::Family::F4);
}

TEST(FitHelmet, KeepsTheClearanceFromAScanWithEarsNoseAndHoles) {
  constexpr unsigned seed = 3;
  const targets::Head scan = targets::make_head(testing::scanned_head(seed), {});
  RibsSpec w = spec();
  w.coverage_mm = scan.coverage_mm;
  const RibsDesign design = fit_helmet(scan.dome, Vector3d::Zero(), w, {});
  EXPECT_LE(design.error.rms, 1.5) << "seed " << seed;
  EXPECT_LE(design.error.max, 5) << "seed " << seed;
  EXPECT_TRUE(design.collisions.empty());
}

/// Compares the corners inside with the equations of head and ears. @return the number of corners inside
int expect_walls_in_ears(RibsSpec w, const SolverOptions& options) {
  const targets::Head ears = targets::make_head(testing::head_with_thin_ears(), {.front = Vector3d::UnitY()});
  w.coverage_mm = ears.coverage_mm;
  const RibsDesign design = fit_helmet(ears.dome, Vector3d::Zero(), w, options);
  const targets::WallsInside found = walls_inside(design.fishbone.structure, design.state, ears.scan);
  int corners = 0;
  for (const model::HalfWall& half : half_walls(design.fishbone.structure)) {
    const OrientedBox box = placed(half, design.state[half.body]);
    for (int k = 0; k < 8; ++k) {
      const Vector3d side(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
      corners +=
          testing::is_in_head_or_ear(ears.to_mesh * (box.center + box.axes * side.cwiseProduct(box.half)));
    }
  }
  EXPECT_NEAR(found.corners, corners, 2 + 0.1 * corners);
  return corners;
}

/// A search that ends early leaves ribs in the ears.
TEST(FitHelmet, SeesWhichWallsRunThroughThinEars) {
  RibsSpec w = spec(5);
  w.size.edge_mm = 10;
  EXPECT_GE(expect_walls_in_ears(w, {.max_evaluations = 20}), 50);
}

TEST(FitHelmetSoak, SeesWhichWallsRunThroughThinEars) { EXPECT_GE(expect_walls_in_ears(spec(), {}), 10); }

TEST(FitHelmet, NamesWallsThatMeetAllTheSame) {
  RibsSpec w = spec(5);
  w.size = {6, 2.8, 4};  // such cells close at 28 deg
  w.theta = {30 * radians_per_degree, 40 * radians_per_degree};
  const RibsDesign design = fit_helmet(head(), {0, 0, 100}, w, {});
  ASSERT_FALSE(design.collisions.empty());
  EXPECT_EQ(design.collisions[0].substr(0, 8), "walls [[");
  EXPECT_LE(design.collisions.size(), 4u);
}

TEST(PlanHelmet, SpacesRibsAsNearToWhatIsAskedAsEvenSpacesCome) {
  for (const double spacing : {20.0, 40.0, 65.0, 100.0, 150.0}) {  // mm
    RibsSpec w = spec();
    w.spacing_mm = spacing;
    const RibsLayout layout = plan_helmet(head(), {0, 0, 100}, w);
    const auto spaces = static_cast<double>(layout.spine_and_ribs.ribs.size()) - 1;
    const double length = (layout.spine_and_ribs.rows - 1) * w.size.edge_mm * std::cos(layout.start.theta);
    const auto off = [&](double count) { return std::abs(length / count - spacing); };
    ASSERT_GE(spaces, 1) << spacing;
    EXPECT_LE(off(spaces), off(spaces + 1)) << spacing;
    if (spaces > 1) {
      EXPECT_LE(off(spaces), off(spaces - 1)) << spacing;
    }
  }
}

TEST(FitHelmet, RefusesMoreRibsThanRows) {
  EXPECT_THROW(fit_helmet(head(), {0, 0, 100}, spec(100), {}), InvalidInput);
}

TEST(FitHelmet, RefusesCellsLargerThanTheHead) {
  RibsSpec w = spec(1);
  w.size = {400, 2, 10};
  EXPECT_THROW(fit_helmet(head(), {0, 0, 100}, w, {}), InvalidInput);
}

TEST(FitHelmet, PlacesItsFishboneWhereTheSearchHadIt) {
  const targets::MeshDistance mesh = head();
  const RibsDesign design = fit_helmet(mesh, {0, 0, 100}, spec(3), {});
  const model::State placed = placed_fishbone(design.fishbone, design.shape, design.shape.theta);
  for (std::size_t b = 0; b < placed.size(); ++b) EXPECT_LE((placed[b].p - design.state[b].p).norm(), 1e-9);
}

}  // namespace
}  // namespace kinetix::optim
