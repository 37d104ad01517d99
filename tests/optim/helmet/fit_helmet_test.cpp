#include "optim/helmet/fit_helmet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/linkage/half_wall.hpp"
#include "targets/helmet/head.hpp"
#include "targets/helmet/walls_inside.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/targets/heads.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
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

/// Corners are looked at by the equations of head and ears.
TEST(FitHelmet, SeesWhichWallsRunThroughThinEars) {
  const targets::Head ears = targets::make_head(testing::head_with_thin_ears(), {.front = Vector3d::UnitY()});
  RibsSpec w = spec();
  w.coverage_mm = ears.coverage_mm;
  const RibsDesign design = fit_helmet(ears.dome, Vector3d::Zero(), w, {});
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
  RecordProperty("corners", corners);
  EXPECT_NEAR(found.corners, corners, 2 + 0.1 * corners);
}

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
