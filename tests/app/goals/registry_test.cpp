#include "app/goals/registry.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/pipeline/pipeline.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using testing::TemporaryFolder;

/// Small and quick targets, one of each kind.
const std::vector<std::string> small_targets = {
    "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [60, 0], [80, 20]]}\n"
    "structure: {cells: [6, 1]}\nsolver: {starts: 1, max_evaluations: 20}\n",
    "kinetix: 1\ntarget: {kind: display, rows: [\"010\", \"111\", \"010\"]}\n"
    "solver: {starts: 1, max_evaluations: 5}\n",
    "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\n",
};

TEST(GoalKind, NamesEveryMetricThatItsSearchesAdd) {
  TemporaryFolder folder;
  for (const std::string& text : small_targets) {
    const Target target = read_target(folder.write("t.yaml", text));
    const app::Run run = run_goal(*target.goal, {.threads = 1, .seed = 0, .verify = false, .progress = {}});
    std::set<std::string_view> named = {"met"};
    for (const GoalMetric& metric : target.kind->metrics) named.insert(metric.name);
    nlohmann::ordered_json metrics;
    run.goal->add_metrics(run, metrics);
    for (const auto& [key, value] : metrics.items()) EXPECT_TRUE(named.contains(key)) << key;
  }
}

TEST(GoalKind, HasAnExampleThatNamesIt) {
  for (const GoalKind* kind : goal_kinds())
    EXPECT_THAT(std::string(kind->example), ::testing::HasSubstr("kind: " + std::string(kind->name)));
}

}  // namespace
}  // namespace kinetix::app
