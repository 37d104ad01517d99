#include <gtest/gtest.h>

#include "model/lattice/square/family/classification.hpp"
#include "tests/sim/runs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::sim {
namespace {

using testing::cube_net;
using testing::fishbone;
using testing::physics_without_contact;
using Status = PhysicsResult::Status;

PhysicsOptions stiff() {
  PhysicsOptions options = physics_without_contact();
  options.joint_stiffness = 1e8;
  return options;
}

void expect_closed_form(const model::Structure& net, const model::Drive& drive, double theta,
                        const PhysicsOptions& options, double tolerance) {
  const PhysicsResult result = run_compression(net, drive_on(net, drive), options);
  EXPECT_EQ(result.status, Status::settled) << result.why;
  EXPECT_LE(aligned_distance(net, result.state, fold(classify(net), net, theta)).max, tolerance);
}

TEST(NetRun, FoldsACubeBetweenPlatesThatGripItsBase) {
  const double theta = 30 * radians_per_degree;
  const model::Structure net = cube_net(60 * radians_per_degree);  // 81.8 deg
  for (const model::Axis axis : {model::Axis::x, model::Axis::y})
    for (const int sign : {1, -1}) {
      auto drive = std::get<model::Plates>(drive_to(net, sign * theta));
      ASSERT_EQ(drive.grip, (model::Grip{{3, 3}, {5, 5}}));
      drive.axis = axis;
      expect_closed_form(net, drive, sign * theta, physics_without_contact(), 1e-7);
    }
}

TEST(NetRun, FoldsACubeWhole) {
  const double theta = 40 * radians_per_degree;
  const model::Structure net = cube_net(model::tilt_of_turn(pi / 2, theta));
  expect_closed_form(net, drive_to(net, theta), theta, physics_without_contact(), 1e-7);
}

TEST(NetRun, FoldsAFishboneByItsSpine) {
  const model::Structure net = fishbone(4, 12, 0.1);
  const auto drive = std::get<model::Plates>(drive_to(net, 0.5));
  ASSERT_EQ(drive.grip, (model::Grip{{4, 0}, {5, 12}}));
  EXPECT_EQ(drive.axis, model::Axis::x);
  expect_closed_form(net, drive, 0.5, stiff(), 1e-7);
}

void expect_random_nets_to_fold(int nets) {
  constexpr unsigned seed = 3;
  std::mt19937 random(seed);
  for (int k = 0; k < nets; ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", net " + std::to_string(k));
    const model::Structure net = testing::random_net(10 + 6 * k, random);
    const double theta = k % 2 ? 0.5 : -0.5;
    expect_closed_form(net, drive_to(net, theta), theta, physics_without_contact(), 1e-7);
  }
}

TEST(NetRun, FoldsRandomNets) { expect_random_nets_to_fold(3); }

TEST(NetRunSoak, FoldsRandomNets) { expect_random_nets_to_fold(6); }

TEST(NetRun, StiffJointsKeepALongRibOnItsWay) {
  const model::Structure net = fishbone(20, 3, 0.05);
  const model::Classification kind = classify(net);
  PhysicsOptions options = stiff();
  options.step_s = 0.004;
  PhysicsObserver observer;
  observer.frame_interval_s = 0.1;
  double farthest = 0;
  observer.frame = [&](double time, const model::State& state) {
    const double tau = std::min(1.0, time / options.drive_seconds);
    const model::State exact = fold(kind, net, 0.5 * tau * (2 - tau));
    farthest = std::max(farthest, aligned_distance(net, state, exact).max);
  };
  run_compression(net, drive_on(net, drive_to(net, 0.5)), options, observer);
  EXPECT_LE(farthest, 0.02);
}

}  // namespace
}  // namespace kinetix::sim
