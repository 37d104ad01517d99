#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/goals/registry.hpp"
#include "app/result/verdict.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/app/searched_goal.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A small box, quick to verify.
constexpr const char* box = R"(kinetix: 1
name: box
target: {kind: fold, box: [2, 1, 1]}
)";

// Three small faces of different sizes: one folds up and one folds down.
constexpr const char* net = R"(kinetix: 1
name: net
target:
  kind: fold
  net:
    faces: [{name: base, cells: [2, 3]}, {name: flap, cells: [2, 2]}, {name: tail, cells: [1, 3]}]
    creases:
      - {faces: [base, flap], side: top, angle_deg: 60}
      - {faces: [base, tail], side: left, angle_deg: -45}
)";

TEST(Fold, IsSearchedVerifiedAndDrawn) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const std::string text = std::string(box) + "tolerance: {angle_deg: 0.3}\n";
  const Outcome run = kinetix_opt(scratch.write("box.yaml", text) + " -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("in the simulation: 5 creases within 0.001 deg, faces "));

  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["target"]["box"], Json({2, 1, 1}));
  EXPECT_EQ(result["target"]["faces"].size(), 6u);
  EXPECT_EQ(result["tolerance"], (Json{{"angle_deg", 0.3}, {"shape", 0.02}, {"verify", 0.02}}));
  EXPECT_EQ(result["plan"]["family"], "F4");
  ASSERT_EQ(result["metrics"]["fold_deg"].size(), 5u);
  for (const double fold : result["metrics"]["fold_deg"]) EXPECT_NEAR(fold, 90, 1e-9);
  EXPECT_LE(result["metrics"]["face_rms"], 1e-12);
  EXPECT_LE(result["metrics"]["face_rms_physics"], 1e-6);
  EXPECT_LE(result["metrics"]["verify_rms"], 1e-6);
  EXPECT_THAT(text_of(folder + "/report.html"), HasSubstr("Net and creases"));

  const Outcome again = kinetix_opt("verify " + folder + "/design.yaml -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  const Outcome exact =
      kinetix_opt("simulate " + folder + "/design.yaml --model exact -o " + scratch.path() + "/exact");
  EXPECT_EQ(exact.code, 0) << exact.out << exact.err;
}

TEST(Fold, OfANetBendsBothWays) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("net.yaml", net) + " -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_NEAR(result["metrics"]["fold_physics_deg"][0], 60, 1e-3);
  EXPECT_NEAR(result["metrics"]["fold_physics_deg"][1], -45, 1e-3);
}

TEST(Fold, OfASingleFaceIsOfOneFace) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(
      scratch.write(
          "net.yaml",
          "kinetix: 1\ntarget: {kind: fold, net: {faces: [{name: a, cells: [2, 2]}], creases: []}}\n") +
      " -o " + scratch.path() + " --no-verify");
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr(" 1 face, 0 columns per crease"));
}

TEST(Fold, ThatCannotBeSaysWhy) {
  const Scratch scratch;
  const std::string text = std::string(box) + "variables: {beta: {range_deg: [-5, 5]}}\n";
  const Outcome run = kinetix_opt(scratch.write("box.yaml", text) + " -o " + scratch.path());
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("needs tilts of"));
  EXPECT_THAT(run.out, HasSubstr("the limit is 5.0 deg. Give it more columns"));
  EXPECT_EQ(schema_errors(Json::parse(text_of(scratch.path() + "/result.json"))), "");
}

/// The cell edge in the message gives the box its size.
TEST(Fold, OfABoxThatMissesItsSizeNamesCellsThatDoNot) {
  const Scratch scratch;
  const auto run = [&](const std::string& edge_mm) {
    return kinetix_opt(scratch.write("box.yaml",
                                     "kinetix: 1\ntarget: {kind: fold, box_mm: [83, 47, 29]}\n"
                                     "structure: {cell_mm: " +
                                         edge_mm + "}\n") +
                       " --no-verify -o " + scratch.path());
  };
  const Outcome missed = run("8");
  EXPECT_EQ(missed.code, 3) << missed.out << missed.err;
  std::smatch edge;
  ASSERT_TRUE(
      std::regex_search(missed.out, edge, std::regex("allowed: structure.cell_mm: ([0-9.]+) comes within")))
      << missed.out;
  EXPECT_THAT(missed.out, HasSubstr(" of the closed box of these cells, limit "));
  const Outcome met = run(edge[1]);
  EXPECT_EQ(met.code, 0) << met.out << met.err;
}

/// The vertices of an open box span its edges. One of these edges has a crease at one end only.
TEST(Fold, OfAnOpenBoxIsAsHighAsItsWalls) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(
      scratch.write("tray.yaml", "kinetix: 1\ntarget: {kind: fold, box_mm: [90, 60, 30], open: top}\n") +
      " --no-verify -o " + folder);
  EXPECT_THAT(run.out, HasSubstr("; requested 90 x 60 x 30 mm"));
  const Json result = Json::parse(text_of(folder + "/result.json"));
  std::array<double, 3> least, most, spans;
  least.fill(INFINITY);
  most.fill(-INFINITY);
  for (const Json& pose : result["states"][0]["poses"])
    for (int k = 0; k < 3; ++k) {
      const double at = pose["position_mm"][k];
      least[k] = std::min(least[k], at);
      most[k] = std::max(most[k], at);
    }
  for (int k = 0; k < 3; ++k) spans[k] = most[k] - least[k];
  auto edges = result["fold"]["edges_mm"].get<std::array<double, 3>>();
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(edges[k], (std::array{90, 60, 30}[k]), 0.02 * edges[k]);
  std::sort(spans.begin(), spans.end());
  std::sort(edges.begin(), edges.end());
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(spans[k], edges[k], 1e-6);
}

TEST(Fold, OfABoxThatMissesItsSizeNamesCellsWithWallsThatItsProcessPrints) {
  const Scratch scratch;
  const app::Run missed =
      searched_goal(*app::read_target(scratch.write("tray.yaml",
                                                    "kinetix: 1\n"
                                                    "target: {kind: fold, box_mm: [90, 60, 30]}\n"
                                                    "structure: {cell_mm: 8}\nprocess: fdm\n"))
                         .goal);
  EXPECT_EQ(exit_code(verdict_of(missed)), app::target_missed);
  EXPECT_THAT(
      missed.violations,
      ::testing::Contains(::testing::ContainsRegex("structure.cell_mm: [0-9.]+ comes within 1\\.[0-9] %$")));
}

TEST(Fold, WhoseWallsCollideSaysAtWhichThetaAndHowFarItWouldHaveToGo) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(
      scratch.write(
          "flap.yaml",
          "kinetix: 1\ntarget: {kind: fold, net: {faces: [{name: a, cells: [2, 2]}, {name: b, cells: [2, "
          "2]}], creases: [{faces: [a, b], side: top, angle_deg: -175}]}}\n"
          "structure: {cell_mm: 10, wall_mm: {thickness: 1.5, height: 14}}\n") +
      " -o " + scratch.path());
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out,
              ::testing::ContainsRegex("with 4 columns per crease, walls of crease `a-b` run into each other "
                                       "at a fold angle of 6\\.[0-9]+ deg; the fold needs 40\\.[0-9]+ deg"));
  EXPECT_THAT(run.out, HasSubstr("goal missed"));
}

TEST(Fold, RefusesBadInputAndWritesNothing) {
  const Scratch scratch;
  const std::string head = "kinetix: 1\ntarget: {kind: fold, ";
  const std::pair<std::string, std::string> cases[] = {
      {head + "box: [4, 0, 4]}\n", "target.box[1]"},
      {head + "box: [4, 4, 4]}\nstructure: {cells: [3, 3]}\n", "follow from its faces"},
      {head + "box: [4, 4, 4]}\nvariables: {beta: {range_deg: [10, 60]}}\n", "has one sign only"},
      {head + "box: [4, 4, 4]}\nvariables: {theta: {range_deg: [44, 44.9]}}\n", "variables"},
      {head + "box: [4, 4, 4]}\ntolerance: {angle: 1}\n", "did you mean `angle_deg`?"},
      {head + "box: [4, 4, 4]}\ntolerance: {size: 0.01}\n",
       "tolerance.size: only applies together with target.box_mm"},
      {head + "net: {faces: [{name: a, cells: [2, 2]}, {name: b, cells: [2, 2]}], creases: []}}\n",
       "Connect all faces"},
  };
  for (const auto& [text, says] : cases) {
    const Outcome run = kinetix_opt(scratch.write("bad.yaml", text) + " -o " + scratch.path() + "/out");
    EXPECT_EQ(run.code, 2) << text << run.out;
    EXPECT_THAT(run.err, HasSubstr(says));
    EXPECT_FALSE(std::filesystem::exists(scratch.path() + "/out"));
  }
}

}  // namespace
}  // namespace kinetix::testing
