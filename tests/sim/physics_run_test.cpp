#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "model/assembly/tiles.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/exact_derivatives.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_run.hpp"
#include "tests/sim/runs.hpp"
#include "tests/support/random_designs.hpp"
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

TEST(StartMotion, IsTheRateOfTheExactFoldAtFlat) {
  std::mt19937 random(31);
  for (const model::Family family : {model::Family::F1, model::Family::F2, model::Family::F3}) {
    auto design = testing::random_design(family, 6, 2, random);
    const model::Structure structure = testing::structure_of(design);
    const std::vector<model::Twist> motion = start_motion(structure);
    design.theta = 0;
    model::State poses;
    model::ExactJacobian jacobian;
    fold_with_jacobian(design, structure.size.edge_mm, poses, jacobian);
    for (const model::Hinge& hinge : structure.hinges) {
      const Eigen::Vector3d relative = motion[hinge.upper].omega - motion[hinge.lower].omega;
      const Eigen::Vector3d exact = jacobian.twist(jacobian.theta(), hinge.upper).omega -
                                    jacobian.twist(jacobian.theta(), hinge.lower).omega;
      const double scale = relative.norm() / exact.norm();
      EXPECT_LE((relative - scale * exact).norm(), 1e-9) << to_string(family);
      EXPECT_GT(relative.dot(exact), 0);
    }
  }
}

TEST(StartMotion, IsBareSpinsWhereNothingMoves) {
  model::Structure structure = make_structure(model::rectangle(3, 3), {});
  std::mt19937 random(32);
  std::uniform_real_distribution<double> unit(0, 1);
  for (model::Hinge& hinge : structure.hinges)
    hinge.parameters = {0.2 + 0.6 * unit(random), 1.2 + 0.7 * unit(random), unit(random) - 0.5};
  const std::vector<model::Twist> motion = start_motion(structure);
  for (std::size_t b = 0; b < motion.size(); ++b) {
    EXPECT_EQ(motion[b].v, Eigen::Vector3d::Zero());
    EXPECT_EQ(motion[b].omega, Eigen::Vector3d(0, 0, structure.bodies[b].sense()));
  }
}

TEST(StartMotion, IsThrownOffTheSameWayByTheSameSeed) {
  std::vector<model::Twist> once(50), again(50), other(50), flat(50), none(50);
  disturb(once, 0.3, 1, false);
  disturb(again, 0.3, 1, false);
  disturb(other, 0.3, 2, false);
  disturb(flat, 0.3, 1, true);
  disturb(none, 0, 1, false);
  double largest = 0;
  for (std::size_t b = 0; b < once.size(); ++b) {
    EXPECT_EQ(once[b].omega, again[b].omega);
    EXPECT_EQ(once[b].v, again[b].v);
    EXPECT_NE(once[b].omega, other[b].omega);
    EXPECT_EQ(flat[b].omega, Eigen::Vector3d(0, 0, once[b].omega.z()));
    EXPECT_EQ(flat[b].v, Eigen::Vector3d(once[b].v.x(), once[b].v.y(), 0));
    EXPECT_EQ(none[b].omega, Eigen::Vector3d::Zero());
    largest = std::max(largest, once[b].v.lpNorm<Eigen::Infinity>());
  }
  EXPECT_LE(largest, 0.3);
  EXPECT_GE(largest, 0.28) << "of 150 numbers";
}

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
      const double turn = sheet.bodies[b].is_in_sublattice_a() ? theta : -theta;
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
                                   wall.from.is_in_sublattice_a() ? -2 * theta : 2 * theta};
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
