#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "tests/app/bow.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

app::Run remedy_run(const std::string& text, const targets::DocumentChanges& changes = {}) {
  const Scratch scratch;
  app::RunOptions options;
  options.verify = false;
  options.seeks_remedy = true;
  const auto goal = app::read_target(scratch.write("goal.yaml", text)).goal;
  return run_goal(changes.empty() ? *goal : *goal->change(changes).goal, options);
}

/// The change that is named is made in the file, and the goal is met.
TEST(Remedy, OfACurveBeyondItsTiltsMeetsTheGoal) {
  const std::string text =
      std::string(bow) + "variables: {beta: {range_deg: [-5, 5]}}\nsolver: {starts: 2}\n";
  const app::Run missed = remedy_run(text);
  ASSERT_FALSE(missed.met());
  EXPECT_THAT(missed.violations.front(),
              HasSubstr("With `variables.beta.range_deg: [-60, 60]` the goal is met"));
  EXPECT_TRUE(remedy_run(text, {{"variables.tilt.range_deg", "[-60, 60]"}}).met());
}

/// Columns can neither climb so much nor so steeply with any fold angle.
TEST(Remedy, OfACurveThatClimbsTooMuchIsNoRefusal) {
  const app::Run missed = remedy_run(
      "kinetix: 1\ntarget: {kind: space_curve, points: [[0, 0, 0], [30, 0, 40], [60, 0, 0], [60, 40, 0], "
      "[60, 40, "
      "40], [100, 80, 40]]}\nstructure: {cells: [24, 1]}\n");
  ASSERT_FALSE(missed.met());
  EXPECT_THAT(missed.violations.front(),
              HasSubstr("of the goal's diagonal; at most 0.01 is allowed; the curve"));
  EXPECT_THAT(missed.violations.front(), HasSubstr("other settings that were searched"));
  EXPECT_THAT(missed.violations.front(), Not(HasSubstr("Allow")));
}

}  // namespace
}  // namespace kinetix::testing
