#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <string>

#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/result/print_evidence.hpp"
#include "app/result/verdict.hpp"
#include "model/tolerance/print_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using ::testing::HasSubstr;

struct PressedGoal {
  Target target;
  Run run;
};

/// Returns an arch of a strip with these hinges.
PressedGoal pressed_arch(const std::string& rest) {
  const testing::TemporaryFolder folder;
  PressedGoal out{read_target(folder.write(
                      "t.yaml",
                      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [25, 6], [50, 8], [75, 6], [100, "
                      "0]]}\nstructure: {cells: [6, 1]}\n" +
                          rest)),
                  {}};
  RunOptions options;
  options.verify = false;
  options.threads = 1;
  out.run = run_goal(*out.target.goal, options);
  return out;
}

const std::string pins = "hinge: {kind: pin, model: elastic, clearance_mm: 0.1, diameter_mm: 2}\n";
const std::string films = "hinge: {kind: film, model: elastic, material: pp, gap_mm: 1, thickness_mm: 0.1}\n";

/// Returns the warning about prints on the other side, if any.
std::string side_warning(const Run& run) {
  for (const Problem& problem : verdict_of(run).problems)
    if (problem.text.find("pressed from flat") != std::string::npos) return problem.text;
  return "";
}

TEST(PrintsPressedFromFlat, WithPinsThatPlayArePushedToASideByTheirErrors) {
  const PressedGoal one = pressed_arch(pins);
  ASSERT_TRUE(one.run.printed && one.run.printed->from_flat);
  const model::FlatStarts& starts = *one.run.printed->from_flat;
  EXPECT_EQ(starts.prints, 20);
  EXPECT_EQ(starts.either_side, 0);
  EXPECT_GT(starts.other_side, 0);
  EXPECT_LT(starts.other_side, 20);
  EXPECT_EQ(print_tolerance_json(one.run)["from_flat"]["other_side"], starts.other_side);
  EXPECT_EQ(side_warning(one.run), "pressed from flat, of 20 simulated prints " +
                                       std::to_string(starts.other_side) +
                                       " fold in the opposite direction. Bend the sheet a little in its fold "
                                       "direction before you press it");
}

TEST(PrintsPressedFromFlat, WithFilmsFoldToEitherSide) {
  const PressedGoal one = pressed_arch(films);
  ASSERT_TRUE(one.run.printed && one.run.printed->from_flat);
  EXPECT_EQ(print_tolerance_json(one.run)["from_flat"],
            (nlohmann::ordered_json{{"prints", 20}, {"other_side", 0}, {"either_side", 20}, {"failed", 0}}));
  EXPECT_THAT(side_warning(one.run), HasSubstr("prints 20 fold in either direction. Bend"));
}

// Springs push to one side, and hinges without stiffness are not pressed. Both need no such prints.
TEST(PrintsPressedFromFlat, AreAskedOnlyOfElasticHingesBetweenPlates) {
  for (const std::string& rest : {films + "drive: {kind: shape_memory, k_turn: 20}\n", std::string()}) {
    const PressedGoal one = pressed_arch(rest);
    ASSERT_TRUE(one.run.printed) << rest;
    EXPECT_FALSE(one.run.printed->from_flat) << rest;
    EXPECT_FALSE(print_tolerance_json(one.run).contains("from_flat"));
    EXPECT_EQ(side_warning(one.run), "");
  }
}

}  // namespace
}  // namespace kinetix::app
