#include <gtest/gtest.h>

#include <limits>

#include "tests/support/bad_input.hpp"
#include "tests/support/linkages.hpp"

namespace kinetix::testing {
namespace {

FreeLinkageOptions at_step(double step_s) {
  FreeLinkageOptions options;
  options.step_s = step_s;
  return options;
}

/// Orders in the step, by halving it.
struct Orders {
  double drift = 0, gap = 0, miss = 0;
  MechanismRun finer;
};

Orders orders(const Mechanism& mechanism, double step_s) {
  const MechanismRun coarse = run_mechanism(mechanism, at_step(2 * step_s)),
                     fine = run_mechanism(mechanism, at_step(step_s));
  return {std::log2(coarse.drift / fine.drift), std::log2(coarse.result.gap.point / fine.result.gap.point),
          std::log2(coarse.miss / fine.miss), fine};
}

TEST(FreeLinkage, StartsClosedAndAtItsKnownRelation) {
  for (const Mechanism& m : {pendulum(), four_bars(1), four_bars(4), bricard(), bennett(), mirrored_unit()}) {
    std::vector<model::Pose> poses;
    for (const FreeLinkageBody& body : m.linkage.bodies) poses.push_back(body.pose);
    const FreeLinkageGap gap = linkage_gap(m.linkage, poses);
    EXPECT_LE(gap.point, 1e-14) << m.name;
    EXPECT_LE(gap.axis, 1e-14) << m.name;
    Mechanism same = m;
    EXPECT_LE(same.miss(0, poses), 1e-14) << m.name;
  }
}

TEST(FreeLinkage, PendulumSwingsByItsClosedForm) {
  const Orders found = orders(pendulum(), 1e-3);
  EXPECT_LE(found.finer.miss, 3e-3);
  EXPECT_LE(found.finer.drift, 2e-3);
  EXPECT_LE(found.finer.result.gap.point, 1e-5);
  EXPECT_NEAR(found.miss, 1, 0.1);
  EXPECT_NEAR(found.drift, 1, 0.1);
  EXPECT_NEAR(found.gap, 2, 0.1);
}

/// Twice a turn all bars of a four-bar lie on one line, where it could leave the parallelogram.
TEST(FreeLinkage, FourBarsStayParallelogramsThroughTheirSingularPosition) {
  for (const int loops : {1, 4, 10}) {
    const Orders found = orders(four_bars(loops), 1e-3);
    EXPECT_LE(found.finer.miss, 5e-4) << loops;
    EXPECT_LE(found.finer.drift, 2e-3) << loops;
    EXPECT_LE(found.finer.result.gap.point, 2e-5) << loops;
    EXPECT_NEAR(found.drift, 1, 0.1) << loops;
    EXPECT_NEAR(found.gap, 2, 0.1) << loops;
  }
}

TEST(FreeLinkage, OverconstrainedLoopsKeepTheirClosedRelations) {
  for (const Mechanism& mechanism : {bricard(), bennett(), mirrored_unit()}) {
    const Orders found = orders(mechanism, 2.5e-4);
    EXPECT_LE(found.finer.miss, 2e-6) << mechanism.name;
    EXPECT_LE(found.finer.result.gap.point, 2e-6) << mechanism.name;
    EXPECT_LE(found.finer.drift, 5e-3) << mechanism.name;
    EXPECT_GE(found.drift, 0.9) << mechanism.name;
    EXPECT_GE(found.gap, 1.9) << mechanism.name;
    EXPECT_GE(found.miss, 1.9) << mechanism.name;
  }
}

TEST(FreeLinkage, MovesFarNotJustAboutItsStart) {
  const MechanismRun run = run_mechanism(bricard(), at_step(1e-3));
  const FreeLinkage linkage = bricard().linkage;
  EXPECT_GT(std::abs(hinge_turn(linkage, 1, run.result.poses)), 0.1);
  const MechanismRun turned = run_mechanism(bennett(), at_step(1e-3));
  EXPECT_GT(std::abs(hinge_turn(bennett().linkage, 0, turned.result.poses)), 0.1);
}

TEST(FreeLinkage, AFreeTopKeepsItsEnergyAndItsAngularMomentum) {
  FreeLinkage top;
  top.bodies.resize(1);
  top.bodies[0].inertia = {0.1, 0.2, 0.4};
  top.bodies[0].motion.omega = {0.5, 3, 0.2};
  FreeLinkageOptions options = at_step(2.5e-4);
  options.seconds = 2;
  const Eigen::Vector3d before = top.bodies[0].inertia.cwiseProduct(top.bodies[0].motion.omega);
  const FreeLinkageResult run = run_linkage(top, options);
  const model::Pose& pose = run.poses[0];
  const Eigen::Vector3d after =
      pose.R * top.bodies[0].inertia.cwiseProduct(pose.R.transpose() * run.motion[0].omega);
  EXPECT_LE(run.energy_drift, 5e-3 * run.energy_start);
  EXPECT_LE((after - before).norm(), 5e-3 * before.norm());
}

TEST(FreeLinkage, ThatRunsTooFastSaysSo) {
  Mechanism mechanism = pendulum();
  FreeLinkageOptions options = at_step(1e-3);
  options.speed_limit = 1;
  const FreeLinkageResult run = run_linkage(mechanism.linkage, options);
  EXPECT_EQ(run.status, FreeLinkageResult::Status::blew_up);
  EXPECT_LT(run.steps, 1000);
}

TEST(FreeLinkage, RefusesWhatIsNone) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const std::function<void(FreeLinkage&)>& spoil) {
    FreeLinkage linkage = four_bars(1).linkage;
    spoil(linkage);
    EXPECT_THROW(run_linkage(linkage, {}), InvalidInput);
  };
  for (const double value : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    refused([&](FreeLinkage& l) { l.bodies[1].mass = value; });
    refused([&](FreeLinkage& l) { l.bodies[1].inertia.y() = value; });
  }
  refused([&](FreeLinkage& l) { l.hinges[0].a = 3; });
  refused([&](FreeLinkage& l) { l.hinges[0].b = l.hinges[0].a; });
  refused([&](FreeLinkage& l) { l.hinges[0].axis *= 2; });
  refused([&](FreeLinkage& l) { l.hinges[0].point.x() = nan; });
  for (double FreeLinkageOptions::*field :
       {&FreeLinkageOptions::step_s, &FreeLinkageOptions::seconds, &FreeLinkageOptions::reach,
        &FreeLinkageOptions::error_reduction, &FreeLinkageOptions::joint_stiffness})
    for (const double value : {0.0, -1.0, nan, 1e13}) {
      FreeLinkageOptions options;
      options.*field = value;
      EXPECT_THROW(run_linkage(pendulum().linkage, options), InvalidInput);
    }
}

}  // namespace
}  // namespace kinetix::testing
