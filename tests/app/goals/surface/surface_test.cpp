#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/goals/read_target.hpp"
#include "app/goals/surface/surface_outcome.hpp"
#include "app/pipeline/pipeline.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/document.hpp"
#include "tests/support/temporary_folder.hpp"

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
  refused(", shape: vase, radius_mm: 2, swell_mm: 1, height_mm: 200", "curves too much for its facets");
}

}  // namespace
}  // namespace kinetix::app
