#include "sim/compression_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/linkage/actuators.hpp"
#include "tests/sim/runs.hpp"

namespace kinetix::sim {
namespace {

using testing::curl;
using testing::expect_exact;
using testing::physics_without_contact;
using testing::run;
using testing::strip;
using testing::structure_of;
using Status = PhysicsResult::Status;

TEST(CompressionRun, ShrinksABasicSheetByTheCosineAndTurnsItsBodiesToAndFro) {
  for (const double theta : {0.6, -0.6}) {
    const model::Structure sheet = make_structure(model::rectangle(3, 3), {});
    const PhysicsResult result = run_compression(sheet, drive_on(sheet, drive_to(sheet, theta)));
    ASSERT_EQ(result.status, Status::settled) << result.why;
    model::State expected = rest_state(sheet);
    for (std::size_t b = 0; b < expected.size(); ++b) {
      const double turn = sheet.bodies[b].is_class_a() ? theta : -theta;
      expected[b].p *= std::cos(theta);
      EXPECT_NEAR(result.state[b].R(0, 0), std::cos(turn), 1e-7);
      EXPECT_NEAR(result.state[b].R(1, 0), std::sin(turn), 1e-7);
    }
    EXPECT_LE(aligned_distance(sheet, result.state, expected).max, 1e-7);
  }
}

TEST(CompressionRun, FoldsABendingStripAsTheReflections) {
  for (const double theta : {0.5, -0.5, 0.05}) {
    const auto design = strip({0.5, 0, 0.5, 0, 0.5, 0}, theta);
    expect_exact(design, run(design));
  }
}

TEST(CompressionRun, CurlsALongStripIntoAHalfCircleBetweenItsPlates) {
  for (const int columns : {10, 40}) {
    const auto design = strip(curl(columns, 3.2 / columns), pi / 6);
    expect_exact(design, run(design));
  }
}

TEST(CompressionRun, FoldsRandomSheetsOfEveryFamily) {
  constexpr unsigned seed = 20;
  std::mt19937 random(seed);
  for (const model::Family family : {model::Family::F1, model::Family::F2, model::Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {6, 1}, {4, 3}}) {
      SCOPED_TRACE(to_string(family) + " " + std::to_string(columns) + "x" + std::to_string(rows));
      const auto design = testing::random_design(family, columns, rows, random);
      expect_exact(design, run(design, physics_without_contact()));
    }
}

TEST(CompressionRun, FoldsAPlanarSheetInThePlane) {
  std::mt19937 random(21);
  auto design = testing::random_design(model::Family::F1, 4, 4, random);
  PhysicsOptions options = physics_without_contact();
  options.planar = true;
  const PhysicsResult result = run(design, options);
  expect_exact(design, result);
  for (const model::Pose& pose : result.state) EXPECT_EQ(pose.p.z(), 0.0);
}

TEST(CompressionRun, FoldsASheetThatBendsAlongY) {
  model::Structure sheet = make_structure(model::rectangle(1, 5), {});
  for (model::Hinge& hinge : sheet.hinges)
    if (hinge.wall.axis == model::Axis::y)
      hinge.parameters.beta = (hinge.wall.from.i & 1 ? -0.15 : 0.15) * hinge.wall.from.j;
  const model::Classification kind = classify(sheet);
  ASSERT_TRUE(kind.transposed);
  for (const double theta : {0.4, -0.4}) {
    const PhysicsResult result = run_compression(sheet, drive_on(sheet, drive_to(sheet, theta)));
    EXPECT_EQ(result.status, Status::settled) << result.why;
    EXPECT_LE(aligned_distance(sheet, result.state, fold(kind, sheet, theta)).max, 1e-7);
  }
}

TEST(CompressionRun, ReachesTheSameStateByADrivenHinge) {
  for (const double theta : {0.45, -0.45}) {
    const auto design = strip({0.3, -0.4, 0.5, 0, 0.2, -0.1}, theta);
    const model::Structure structure = structure_of(design);
    for (const model::Wall& wall :
         {model::Wall{{0, 0}, model::Axis::y}, model::Wall{{3, 0}, model::Axis::y}}) {
      const model::HingeTurn drive{*structure.hinge_at(wall),
                                   wall.from.is_class_a() ? -2 * theta : 2 * theta};
      expect_exact(design, run_compression(structure, drive_on(structure, drive)));
    }
  }
}

/// Only the tendon holds revolute joints back: a sheet that coasts ahead of it would stay there.
TEST(CompressionRun, FoldsAsFarAsItsCordGetsShorterAndNoFurther) {
  const model::Structure sheet = make_structure(model::rectangle(4, 3), {});
  std::vector<int> through;
  for (int i = 0; i <= 4; ++i) through.push_back(*sheet.hinge_at({{i, 1}, model::Axis::y}));
  const double shorten_mm = 0.1 * cord_length(sheet, through, rest_state(sheet));
  for (const int branch : {1, -1})
    for (const double step_s : {0.01, 0.001}) {
      PhysicsOptions options = physics_without_contact();
      options.step_s = step_s;
      const PhysicsResult result =
          run_compression(sheet, cord_drive(sheet, through, shorten_mm, branch), options);
      ASSERT_EQ(result.status, Status::settled) << result.why;
      const model::State expected = fold(classify(sheet), sheet, branch * std::acos(0.9));
      EXPECT_LE(aligned_distance(sheet, result.state, expected).max, 1e-4);
    }
}

TEST(CompressionRun, TurnsAHingeBeyondAQuarterTurn) {
  auto design = model::ExactDesign<double>::basic(3, 1);
  design.t = {0.7, 0.8, 0.7};
  for (const double theta : {0.95, -0.95}) {
    design.theta = theta;
    expect_exact(design, run(design, physics_without_contact()));
    const model::Structure structure = structure_of(design);
    const model::HingeTurn drive{*structure.hinge_at({{0, 0}, model::Axis::y}), -2 * theta};
    expect_exact(design, run_compression(structure, drive_on(structure, drive), physics_without_contact()));
  }
}

/// Returns a spine along y, one cell wide, whose even rows carry ribs. Its odd rows and the ribs' columns bend.
model::Structure fishbone() {
  std::vector<model::Cell> cells;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 7; ++i)
      if (i == 3 || j % 2 == 0) cells.push_back({i, j});
  model::Structure net = make_structure(std::move(cells), {});
  for (model::Hinge& hinge : net.hinges) {
    const auto [i, j] = hinge.wall.from;
    const bool along_x = hinge.wall.axis == model::Axis::x;
    const double tilt = along_x ? (i == 3 ? 0 : 0.1 * i) : (j % 2 ? 0.2 * j : 0);
    hinge.parameters.beta = ((along_x ? j : i) & 1) ? -tilt : tilt;
  }
  return net;
}

TEST(CompressionRun, FoldsANetFromOneHingeWithoutStrain) {
  const model::Structure net = fishbone();
  const model::HingeTurn drive{*net.hinge_at({{0, 0}, model::Axis::y}), -0.8};
  const PhysicsResult result = run_compression(net, drive_on(net, drive));
  EXPECT_EQ(result.status, Status::settled) << result.why;
  EXPECT_LE(result.gaps.max, 1e-10);
  for (const model::Hinge& hinge : net.hinges) {
    if (hinge.parameters.beta != 0) continue;
    const Eigen::Matrix3d turn = result.state[hinge.lower].R.transpose() * result.state[hinge.upper].R;
    EXPECT_NEAR(turn(0, 0), std::cos(0.8), 1e-7) << "all vertical hinges share one theta";
  }
}

TEST(CompressionRun, GivesTheSameBitsTwice) {
  const auto design = strip(curl(12, 0.2), 0.5);
  const PhysicsResult first = run(design), second = run(design);
  EXPECT_EQ(first.steps, second.steps);
  for (std::size_t b = 0; b < first.state.size(); ++b) {
    EXPECT_EQ(first.state[b].p, second.state[b].p);
    EXPECT_EQ(first.state[b].R, second.state[b].R);
  }
}

TEST(CompressionRun, StaysFlatWhenNothingIsAsked) {
  const auto design = strip(curl(4, 0.3), 0.0);
  expect_exact(design, run(design), 1e-12);
}

TEST(CompressionRun, ShowsFramesFromFlatToTheEndAndRisingProgress) {
  const auto design = strip(curl(3, 0.3), 0.4);
  const model::Structure structure = structure_of(design);
  std::vector<double> times, shares;
  model::State first, last;
  PhysicsObserver observer;
  observer.frame_interval_s = 0.1;
  observer.progress = [&](double done) { shares.push_back(done); };
  observer.frame = [&](double time, const model::State& state) {
    if (times.empty()) first = state;
    times.push_back(time);
    last = state;
  };
  const PhysicsResult result =
      run_compression(structure, drive_on(structure, drive_to(structure, 0.4)), {}, observer);
  ASSERT_GE(times.size(), 11u);
  for (int k = 0; k < 11; ++k) EXPECT_NEAR(times[k], 0.1 * k, 1e-9);
  EXPECT_EQ(times.back(), result.simulated_s);
  EXPECT_LE(aligned_distance(structure, first, rest_state(structure)).max, 1e-12);
  EXPECT_LE(aligned_distance(structure, last, result.state).max, 1e-12);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

}  // namespace
}  // namespace kinetix::sim
