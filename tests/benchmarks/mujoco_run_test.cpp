#include "benchmarks/peers/mujoco_run.hpp"

#include <gtest/gtest.h>

#include "benchmarks/scenes.hpp"
#include "model/invalid_input.hpp"

namespace kinetix::bench {
namespace {

Drive driven(const ExactDesign<double>& design) {
  Drive drive;
  drive.kind = Drive::Kind::hinge;
  drive.wall = {{design.columns() / 2, design.rows() / 2}, Axis::y};
  if (design.rows() == 1) drive.wall.from.j = 0;
  drive.angle = -2 * drive.wall.from.sense() * design.theta;
  return drive;
}

class MujocoRun : public ::testing::TestWithParam<const char*> {
 protected:
  static MujocoSettings settings() {
    MujocoSettings settings;
    settings.bodies =
        std::string(GetParam()) == "tree" ? MujocoSettings::Bodies::tree : MujocoSettings::Bodies::free;
    return settings;
  }

  void SetUp() override {
    if (!has_mujoco()) GTEST_SKIP() << "MuJoCo is not installed";
  }
};

TEST_P(MujocoRun, SettlesInTheClosedForm) {
  for (const auto& [columns, rows] : {std::pair{8, 1}, {4, 4}}) {
    ExactDesign<double> design;
    const Structure structure = arc(columns, rows, design);
    const MujocoResult run = run_mujoco(structure, driven(design), settings());
    EXPECT_EQ(run.status, MujocoResult::Status::settled) << to_string(run.status);
    EXPECT_LT(run.gaps.max, 1e-5);
    EXPECT_LT(run.drive_gap, 1e-5);
    EXPECT_LT(aligned_distance(structure, run.state, fold(design, structure)).rms, 1e-5);
  }
}

TEST_P(MujocoRun, TakesNoPlates) {
  ExactDesign<double> design;
  const Structure structure = arc(4, 1, design);
  EXPECT_THROW(run_mujoco(structure, Drive{}, settings()), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Bodies, MujocoRun, ::testing::Values("free", "tree"));

}  // namespace
}  // namespace kinetix::bench
