#include <gtest/gtest.h>
#include <algorithm>

#include "app/goals/registry.hpp"
#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/physics.hpp"
#include "app/pipeline/pipeline.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/app/program.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::app {
namespace {

constexpr double theta = 0.5;        // rad: far from flat and from contact
constexpr double usual_step = 1e-3;  // s: the default of PhysicsOptions

struct Folded {
  Run run;
  PhysicsTask task;

  explicit Folded(double physics_theta = theta) {
    run.design.structure = testing::bending_strip();
    run.plan = make_plan(run.design.structure);
    run.theta = theta;
    run.states.push_back(exact_state(run, "target", theta));
    task = {run.states.front().poses, drive_to(run.design.structure, physics_theta),
            physics_of(run.design, run.plan.planar)};
  }

  void verify() { run.verification = app::verify(run, task, {}).value(); }
};

TEST(Verify, TakesALongStepWhereItEndsWhereTheModelSays) {
  Folded folded;
  folded.verify();
  ASSERT_TRUE(folded.run.verification);
  EXPECT_TRUE(folded.run.verification->agrees);
  EXPECT_DOUBLE_EQ(folded.run.verification->options.step_s, 10 * usual_step);
  EXPECT_LT(folded.run.verification->distance.rms, 1e-7);
}

TEST(Verify, LeavesTheVerdictOnAWrongStateToTheUsualStep) {
  Folded folded(0.9 * theta);
  folded.verify();
  ASSERT_TRUE(folded.run.verification);
  EXPECT_FALSE(folded.run.verification->agrees);
  EXPECT_TRUE(is_settled(*folded.run.verification));
  EXPECT_DOUBLE_EQ(folded.run.verification->options.step_s, usual_step);
  EXPECT_GT(folded.run.verification->distance.rms, folded.run.verify_tolerance);
}

TEST(Verify, TakesTheStepThatWasAskedFor) {
  Folded folded;
  folded.run.design.physics.step_s = 2e-3;
  folded.task.options = physics_of(folded.run.design, folded.run.plan.planar);
  folded.verify();
  ASSERT_TRUE(folded.run.verification);
  EXPECT_DOUBLE_EQ(folded.run.verification->options.step_s, 2e-3);
}

TEST(Verify, HoldsHingesThatCannotStretchAtTheReachOfTheFile) {
  Folded folded;
  folded.run.design.hinge.reach_mm = 0.3 * folded.run.design.structure.size().edge_mm;
  EXPECT_DOUBLE_EQ(physics_of(folded.run.design, folded.run.plan.planar).reach, 0.3);
}

TEST(Verify, TakesTheUsualStepWhereNoModelKnowsTheEnd) {
  Folded folded;
  folded.task.reference.clear();
  folded.verify();
  ASSERT_TRUE(folded.run.verification);
  EXPECT_FALSE(folded.run.verification->compared);
  EXPECT_DOUBLE_EQ(folded.run.verification->options.step_s, usual_step);
}

/// Long steps give creases an error of 3e-10 deg. The default steps give less than 1e-10 deg.
TEST(Verify, RepeatsLongStepsThatMissAStricterGoal) {
  const auto physics_of = [](const std::string& degrees) {
    const testing::Scratch scratch;
    const app::Run run =
        run_goal(*read_target(scratch.write("goal.yaml",
                                            "kinetix: 1\ntarget: {kind: fold, box: [1, 1, 1], open: "
                                            "top}\ntolerance: {angle_deg: " +
                                                degrees + "}\n"))
                      .goal,
                 {});
    EXPECT_TRUE(run.met() && run.verification && run.verification->agrees) << degrees;
    const auto is_physics = [](const NamedState& state) { return state.model == to_string(Model::bullet); };
    EXPECT_EQ(std::count_if(run.states.begin(), run.states.end(), is_physics), 1) << degrees;
    return *run.verification;
  };
  EXPECT_GT(physics_of("1").options.step_s, usual_step);
  EXPECT_DOUBLE_EQ(physics_of("1e-10").options.step_s, usual_step);
}

}  // namespace
}  // namespace kinetix::app
