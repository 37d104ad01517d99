#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/goals/read_target.hpp"
#include "app/goals/surface/ribs_outcome.hpp"
#include "app/goals/surface/surface_outcome.hpp"
#include "app/pipeline/pipeline.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/document.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::app {
namespace {

using ::testing::HasSubstr;

Target read(const testing::TemporaryFolder& folder, const std::string& target, const std::string& rest = "") {
  return read_target(
      folder.write("surface.yaml", "kinetix: 1\ntarget: {kind: surface" + target + "}\n" + rest));
}

TEST(SurfaceGoal, FoldsASheetOntoASaddle) {
  const testing::TemporaryFolder folder;
  RunOptions options;
  options.verify = false;
  const Target target = read(folder, ", shape: saddle, rise: 0.15", "structure: {facets: [4, 4]}\n");
  const auto run = run_scene(*target.goal, options);
  const auto& outcome = outcome_of<SurfaceOutcome>(run);
  EXPECT_TRUE(outcome.design.within);
  EXPECT_EQ(run.plan.exact.name, "creased");
  EXPECT_LE(run.states.front().gaps.max, 1e-11);
  EXPECT_EQ(run.structure.bodies(), 64);
  nlohmann::ordered_json metrics;
  outcome.add_metrics(metrics);
  EXPECT_LE(metrics["surface_rms"].get<double>(), 0.05);
  ASSERT_EQ(outcome.ways.size(), 3);
  EXPECT_EQ(outcome.ways[0].rms, outcome.design.error.rms);
  EXPECT_EQ(outcome.ways[1].pieces, 1);
  EXPECT_EQ(outcome.ways[2].pieces, 4);
  for (const SurfaceWay& way : {outcome.ways[1], outcome.ways[2]}) {
    EXPECT_LE(way.rms, 2e-3);
    EXPECT_GT(way.open, outcome.ways[0].open);
  }
}

TEST(SurfaceGoal, LaysRibsOverAClosedMesh) {
  const testing::TemporaryFolder folder;
  folder.write("ball.obj", testing::obj_text(testing::ellipsoid({60, 40, 40})));
  const Target target = read(folder, ", mesh: ball.obj, ribs: 4");
  const auto run = run_scene(*target.goal, {});
  const auto& outcome = outcome_of<RibsOutcome>(run);
  EXPECT_TRUE(outcome.met());
  EXPECT_LE(outcome.ways.front().rms, 5e-3);
  EXPECT_EQ(outcome.ways.back().pieces, 4);
  EXPECT_LE(run.states.front().gaps.max, 1e-11);
  ASSERT_TRUE(outcome.settled.has_value());
  EXPECT_NEAR(outcome.settled->rms, outcome.ways.front().rms, 1e-3);
  for (const model::Pose& pose : run.states.front().poses)
    EXPECT_NEAR(pose.p.cwiseQuotient(Eigen::Vector3d(60, 40, 40)).norm(), 1, 0.1);
}

TEST(SurfaceGoal, TurnsAProfileForASheetAndForRibs) {
  const testing::TemporaryFolder folder;
  RunOptions options;
  options.verify = false;
  const std::string stool = ", profile: [[50, 0], [42, 30], [39, 60], [42, 90], [50, 120]]";
  const auto sheet = run_scene(*read(folder, stool, "structure: {facets: [5, 3]}\n").goal, options);
  EXPECT_LE(outcome_of<SurfaceOutcome>(sheet).design.error.rms, 0.02);
  const auto ribs = run_scene(*read(folder, stool + ", ribs: 5").goal, options);
  const auto& outcome = outcome_of<RibsOutcome>(ribs);
  EXPECT_TRUE(outcome.met());
  EXPECT_LE(outcome.ways.front().rms, 3e-3);
  double lowest = 0;  // mm: ribs run round to the back
  for (const model::Pose& pose : ribs.states.front().poses) lowest = std::min(lowest, pose.p.z());
  EXPECT_LT(lowest, -30);
}

TEST(SurfaceGoal, SaysHowMuchASheetLacksAndThatRibsWouldDo) {
  const testing::TemporaryFolder folder;
  RunOptions options;
  options.verify = false;
  const Target target =
      read(folder, ", shape: cap, arc_deg: 120", "structure: {facets: [3, 3]}\ntolerance: {shape: 0.01}\n");
  const auto run = run_scene(*target.goal, options);
  EXPECT_FALSE(run.goal->met());
  EXPECT_THAT(run.goal->violations, ::testing::Contains(HasSubstr("of its curvature")));
  EXPECT_THAT(run.goal->violations, ::testing::Contains(HasSubstr("`target.ribs: 3`")));
}

TEST(SurfaceGoal, RefusesWhatItCannotRead) {
  const testing::TemporaryFolder folder;
  const auto refused = [&](const std::string& target, const std::string& says) {
    try {
      read(folder, target);
      ADD_FAILURE() << target << " was accepted";
    } catch (const InvalidInput& e) {
      EXPECT_THAT(e.what(), HasSubstr(says)) << target;
    }
  };
  refused("", "needs a `mesh` or a `shape`");
  refused(", shape: cap, rise: 0.2", "belongs to a saddle");
  refused(", shape: cap, arc_deg: 170", "140");
  folder.write("tiny.obj", testing::obj_text(testing::cube(0.1)));
  folder.write("cube.obj", testing::obj_text(testing::cube(50)));
  refused(", mesh: cube.obj", "give `target.ribs`");
  refused(", mesh: tiny.obj, ribs: 3", "`units` says");
  refused(", shape: cap, ribs: 0", "target.ribs");
  refused(", mesh: cube.obj, ribs: 3, arc_deg: 20", "belongs to a shape");
  refused(", shape: cap, ribs: 3}\nstructure: {facets: [3, 3]", "belongs to a sheet of facets");
  refused(", shape: cap}\nstructure: {cell_mm: 3", "belongs to `target.ribs`");
  refused(", shape: cap, ribs: 9}\nstructure: {cell_mm: 20", "ribs overlap flat");
  refused(", profile: [[10, 0], [12, 5], [9, 4]]", "must ascend");
  refused(", profile: [[10, 0], [12, 50]], shape: cap", "both say what the surface is");
  refused(", profile: [[10, 0], [12, 50]], width_mm: 3", "belongs to a shape");
  refused(", profile: [[10, 0], [12, 50]], arc_deg: 200", "120");
  refused(", shape: vase, radius_mm: 2, swell_mm: 0.8, height_mm: 200", "curves too much for its facets");
  refused(", shape: vase, radius_mm: 50, swell_mm: 15, arc_deg: 100", "0.95 of the neck's width, 70 mm");
}

}  // namespace
}  // namespace kinetix::app
