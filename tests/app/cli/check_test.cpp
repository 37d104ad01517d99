#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

Json checked(const std::string& text) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("check --json " + scratch.write("in.yaml", text));
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  return Json::parse(run.out);
}

/// What the search finds of the same file.
Json found(const std::string& text) {
  const Scratch scratch;
  kinetix_opt(std::string(scratch.write("in.yaml", text)) + " --no-verify -o " +
              std::string(scratch / "out"));
  return Json::parse(text_of(scratch / "out/result.json"));
}

const std::vector<std::string> targets = {
    "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [50, 40], [100, 50], [150, 40], [200, 0]]}\n",
    "kinetix: 1\ntarget: {kind: display, rows: ['0110', '1001', '1111', '1001']}\n",
    "kinetix: 1\ntarget: {kind: fold, box: [2, 3, 2], open: top}\n",
    "kinetix: 1\ntarget: {kind: fold, box_mm: [60, 40, 40]}\n",
    "kinetix: 1\ntarget: {kind: outline, points: [[0, 0], [100, 0], [100, 60], [0, 60]]}\n"
    "structure: {cells: [6, 4], trim: none}\n",
};

TEST(Check, TellsBeforehandWhatTheRunWillHave) {
  for (const std::string& target : targets) {
    const Json expected = checked(target)["expected"], result = found(target);
    EXPECT_EQ(expected["bodies"], result["structure"]["bodies"].size()) << target;
    EXPECT_EQ(expected["hinges"], result["structure"]["hinges"].size()) << target;
    EXPECT_GE(expected["physics_s"], 0);
    EXPECT_GT(expected["memory_bytes"], 1e6);
  }
}

TEST(Check, TellsTheSizeOfAFoldedBox) {
  const Json expected = checked(targets[3])["expected"], edges = found(targets[3])["fold"]["edges_mm"];
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(expected["folded_mm"][k].get<double>(), edges[k].get<double>(),
                0.03 * edges[k].get<double>());
}

TEST(Check, SaysInWordsWhichStrokesAreLost) {
  const Scratch scratch;
  const std::string file =
      scratch.write("w.yaml", "kinetix: 1\ntarget: {kind: display, glyph: W}\nstructure: {cells: [6, 6]}\n");
  const Outcome run = kinetix_opt("check " + file);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("thinner than a cell"));
  EXPECT_THAT(run.out, HasSubstr("49 bodies"));
}

TEST(Check, CountsTheSamplesOfASweep) {
  const Scratch scratch;
  const Outcome run =
      kinetix_opt(std::string("check ") + KINETIX_SOURCE + "/targets/sweeps/eq3_area.yaml --json");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["samples"], 97);
}

}  // namespace
}  // namespace kinetix::testing
