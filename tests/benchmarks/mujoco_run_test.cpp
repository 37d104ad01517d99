#include "benchmarks/peers/mujoco_run.hpp"

#include <gtest/gtest.h>

#include "benchmarks/scenes.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/support/elastic_runs.hpp"

namespace kinetix::bench {
namespace {

class MujocoRun : public ::testing::TestWithParam<const char*> {
 protected:
  static MujocoSettings settings() {
    MujocoSettings settings;
    settings.bodies =
        std::string(GetParam()) == "tree" ? MujocoSettings::Bodies::tree : MujocoSettings::Bodies::free;
    return settings;
  }
};

TEST_P(MujocoRun, SettlesInTheClosedForm) {
  for (const auto& [columns, rows] : {std::pair{8, 1}, {4, 4}}) {
    model::ExactDesign<double> design;
    const model::Structure structure = arc(columns, rows, design);
    const model::LinkageDrive drive = drive_on(
        structure, hinge_drive_to(structure, {{columns / 2, rows / 2}, model::Axis::y}, design.theta));
    const MujocoResult run = run_mujoco(structure, drive, settings());
    EXPECT_EQ(run.status, MujocoResult::Status::settled) << to_string(run.status);
    EXPECT_LT(run.gaps.max, 1e-5);
    EXPECT_LT(run.drive_gap, 1e-5);
    EXPECT_LT(aligned_distance(structure, run.state, fold(design, structure)).rms, 1e-5);
  }
}

TEST_P(MujocoRun, TakesNoPlates) {
  model::ExactDesign<double> design;
  const model::Structure structure = arc(4, 1, design);
  EXPECT_THROW(run_mujoco(structure, model::LinkageDrive{}, settings()), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Bodies, MujocoRun, ::testing::Values("free", "tree"));

}  // namespace
}  // namespace kinetix::bench
