#include <gtest/gtest.h>

#include "model/classify.hpp"
#include "tests/sim/runs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix {
namespace {

using testing::cube_net;
using testing::fishbone;
using testing::without_contact;
using Status = PhysicsResult::Status;

PhysicsOptions stiff() {
  PhysicsOptions options = without_contact();
  options.joint_stiffness = 1e8;
  return options;
}

void expect_closed_form(const Structure& net, const Drive& drive, const PhysicsOptions& options,
                        double tolerance) {
  const PhysicsResult result = run_compression(net, drive, options);
  EXPECT_EQ(result.status, Status::settled) << result.why;
  EXPECT_LE(aligned_distance(net, result.state, fold(classify(net), net, drive.theta())).max, tolerance);
}

TEST(NetRun, FoldsACubeBetweenPlatesThatGripItsBase) {
  const double theta = 30 * radians_per_degree;
  const Structure net = cube_net(60 * radians_per_degree);  // 81.8 deg
  for (const Axis axis : {Axis::x, Axis::y})
    for (const int sign : {1, -1}) {
      Drive drive = drive_to(net, sign * theta);
      ASSERT_EQ(drive.grip, (Grip{{3, 3}, {5, 5}}));
      drive.axis = axis;
      expect_closed_form(net, drive, without_contact(), 1e-7);
    }
}

TEST(NetRun, FoldsACubeWhole) {
  const double theta = 40 * radians_per_degree;
  const Structure net = cube_net(tilt_of_turn(pi / 2, theta));
  expect_closed_form(net, drive_to(net, theta), without_contact(), 1e-7);
}

TEST(NetRun, FoldsAFishboneByItsSpine) {
  const Structure net = fishbone(5, 20, 0.1);
  const Drive drive = drive_to(net, 0.5);
  ASSERT_EQ(drive.grip, (Grip{{5, 0}, {6, 20}}));
  EXPECT_EQ(drive.axis, Axis::x);
  expect_closed_form(net, drive, stiff(), 1e-7);
}

TEST(NetRun, FoldsRandomNets) {
  constexpr unsigned seed = 3;
  std::mt19937 random(seed);
  for (int k = 0; k < 6; ++k) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", net " + std::to_string(k));
    const Structure net = testing::random_net(10 + 6 * k, random);
    expect_closed_form(net, drive_to(net, k % 2 ? 0.5 : -0.5), without_contact(), 1e-7);
  }
}

TEST(NetRun, StiffJointsKeepALongRibOnItsWay) {
  const Structure net = fishbone(20, 3, 0.05);
  const Classification kind = classify(net);
  PhysicsOptions options = stiff();
  options.step_s = 0.004;
  PhysicsObserver observer;
  observer.frame_interval_s = 0.1;
  double farthest = 0;
  observer.frame = [&](double time, const State& state) {
    const double tau = std::min(1.0, time / options.drive_seconds);
    const State exact = fold(kind, net, 0.5 * tau * (2 - tau));
    farthest = std::max(farthest, aligned_distance(net, state, exact).max);
  };
  run_compression(net, drive_to(net, 0.5), options, observer);
  EXPECT_LE(farthest, 0.02);
}

}  // namespace
}  // namespace kinetix
