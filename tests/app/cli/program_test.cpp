#include "tests/app/program.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/bow.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

Json without_times(Json result) {
  result.erase("timing_s");
  result.erase("fidelity");
  result["physics"].erase("seconds");
  return result;
}

TEST(Program, FindsVerifiesAndWritesADesign) {
  const Scratch scratch;
  const std::string target = scratch.write("bow.yaml", bow), folder = scratch / "out";
  const Outcome run = kinetix_opt(target + " -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, StartsWith("bow: goal met, "));
  EXPECT_THAT(run.out, HasSubstr("simulation agrees"));

  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["plan"]["family"], "F2");
  EXPECT_EQ(result["tolerance"], (Json{{"shape", 0.01}, {"verify", 0.02}}));
  EXPECT_LE(result["metrics"]["shape_rms"], 0.01);
  EXPECT_LE(result["metrics"]["verify_rms"], 5e-3);
  EXPECT_LE(result["states"][0]["hinge_gap_max"], 1e-12);
  EXPECT_THAT(text_of(folder + "/report.html"), HasSubstr("bow"));
}

TEST(Program, ItsOwnDesignCanBeVerifiedAndSimulated) {
  const Scratch scratch;
  const std::string first = scratch / "first", again = scratch / "again";
  ASSERT_EQ(kinetix_opt(scratch.write("bow.yaml", bow) + " --no-verify -o " + first).code, 0);
  const Json found = Json::parse(text_of(first + "/result.json"));

  const Outcome verified = kinetix_opt("verify " + first + "/design.yaml -o " + again);
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  const Json physics = Json::parse(text_of(again + "/result.json"));
  EXPECT_EQ(schema_errors(physics), "");
  EXPECT_EQ(physics["structure"], found["structure"]);
  EXPECT_EQ(physics["tolerance"], (Json{{"verify", 0.02}})) << "a design has no goal";
  EXPECT_NEAR(physics["metrics"]["theta_rad"], found["metrics"]["theta_rad"], 1e-12);
  EXPECT_LE(physics["metrics"]["verify_rms"], 5e-3);

  const Outcome half =
      kinetix_opt("simulate " + first + "/design.yaml --model exact --theta-deg 10 -o " + again);
  EXPECT_EQ(half.code, 0) << half.err;
  EXPECT_NEAR(Json::parse(text_of(again + "/result.json"))["metrics"]["theta_rad"], 10 * M_PI / 180, 1e-12);
}

TEST(Program, NeverReplacesItsOwnInput) {
  const Scratch scratch;
  const std::string goal = scratch.write("design.yaml", std::string("# by hand\n") + bow),
                    found = scratch / "found", design = found + "/design.yaml";
  ASSERT_EQ(kinetix_opt(goal + " --quiet --no-verify -o " + found).code, 0);
  const std::string result = text_of(found + "/result.json"), text = text_of(design);
  for (const std::string& command :
       {goal + " --no-verify -o " + scratch.path(), "verify " + design + " -o " + found,
        "simulate " + found + " --theta-deg 20 -o " + found,
        "simulate " + found + "/result.json -o " + found + "/../found"}) {
    const Outcome run = kinetix_opt(command + " --quiet");
    EXPECT_EQ(run.code, 2) << command << run.out;
    EXPECT_THAT(run.err, HasSubstr("design.yaml: results in ")) << command;
    EXPECT_THAT(run.err, HasSubstr("would replace this file. Give another folder: -o DIR")) << command;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_EQ(text_of(goal), std::string("# by hand\n") + bow);
  EXPECT_FALSE(fs::exists(scratch / "result.json"));
  EXPECT_EQ(text_of(design), text);
  EXPECT_EQ(text_of(found + "/result.json"), result);
}

TEST(Program, KeepsADesignThatWasChangedByHand) {
  const Scratch scratch;
  const std::string goal = scratch.write("bow.yaml", bow), found = scratch / "found",
                    design = found + "/design.yaml", kept = found + "/design_changed.yaml";
  const auto search = [&] { return kinetix_opt(goal + " --no-verify -o " + found); };
  ASSERT_EQ(search().code, 0);
  const std::string written = text_of(design), changed = written + "# my own\n";
  EXPECT_THAT(search().err, Not(HasSubstr("changed")));
  EXPECT_FALSE(fs::exists(kept)) << "nobody changed it";
  scratch.write("found/design.yaml", changed);
  EXPECT_THAT(search().err, HasSubstr("is kept as " + kept));
  EXPECT_EQ(text_of(design), written);
  EXPECT_EQ(text_of(kept), changed);
  scratch.write("found/design.yaml", "");
  search();
  EXPECT_EQ(text_of(kept), changed);
  EXPECT_TRUE(fs::exists(found + "/design_changed_2.yaml"));
}

/// A design may already be in the default folder of its results. The results then go to a folder next to it.
TEST(Program, WritesBesideItsInputWhereThatIsTheUsualFolder) {
  const Scratch scratch;
  const std::string goal = scratch.write("bow.yaml", bow), there = "cd " + scratch.path() + " && ";
  ASSERT_EQ(kinetix_opt(goal + " --quiet --no-verify", there).code, 0);
  for (const char* command : {"verify results/bow", "verify results/bow_verified", "simulate results/bow",
                              "simulate results/bow_exact --theta-deg 5"})
    EXPECT_EQ(kinetix_opt(std::string(command) + " --quiet", there).code, 0) << command;
  EXPECT_TRUE(fs::exists(scratch / "results/bow_verified_2/design.yaml"));
  const auto theta = [&](const char* folder) {
    return Json::parse(text_of(scratch / folder / "result.json"))["metrics"]["theta_rad"].get<double>();
  };
  EXPECT_NEAR(theta("results/bow_exact_2"), 5 * M_PI / 180, 1e-12);
  EXPECT_NEAR(theta("results/bow_exact"), theta("results/bow"), 1e-12) << "the input stays";
}

/// A result.json names the design next to it. The message says so if that design is missing.
TEST(Program, SaysWhichFileAResultNeeds) {
  const Scratch scratch;
  const std::string goal = scratch.write("bow.yaml", bow), found = scratch / "found",
                    result = found + "/result.json";
  ASSERT_EQ(kinetix_opt(goal + " --quiet --no-verify -o " + found).code, 0);
  EXPECT_EQ(kinetix_opt("check " + result).out, kinetix_opt("check " + found).out);
  EXPECT_THAT(kinetix_opt("check " + found).out, HasSubstr("valid design 'bow'"));
  const Outcome searched = kinetix_opt(result);
  EXPECT_EQ(searched.code, 2);
  EXPECT_THAT(searched.err, HasSubstr("this file is a result"));
  EXPECT_THAT(searched.err, HasSubstr("Give " + found + "/design.yaml"));
  fs::remove(found + "/design.yaml");
  for (const auto& [command, options] : {std::pair("verify ", ""),
                                         {"simulate ", ""},
                                         {"check ", ""},
                                         {"view --no-open ", ""},
                                         {"export ", " --format stl"}}) {
    const Outcome lone = kinetix_opt(command + result + options);
    EXPECT_EQ(lone.code, 2) << command;
    EXPECT_THAT(lone.err, HasSubstr("the design.yaml that was written with it, which is not in its folder"))
        << command;
  }
}

TEST(Program, PrintsTheDocumentItWrites) {
  const Scratch scratch;
  const Outcome run =
      kinetix_opt(scratch.write("bow.yaml", bow) + " --json --quiet --no-verify -o " + scratch.path());
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, text_of(scratch / "result.json"));
}

TEST(Program, SameSeedSameAnswerForAnyNumberOfThreads) {
  const Scratch scratch;
  const std::string target = scratch.write("bow.yaml", std::string(bow) + "solver: {starts: 24}\n");
  std::vector<Json> results;
  for (const char* threads : {"1", "2", "5"}) {
    const Outcome run =
        kinetix_opt(target + " --json --seed 7 --threads " + threads + " -o " + scratch.path());
    results.push_back(without_times(Json::parse(run.out)));
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(Program, EndsWith3AndSaysWhyWhenTheBoundsMissTheTarget) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run =
      kinetix_opt(scratch.write("bow.yaml", std::string(bow) + "variables: {beta: {range_deg: [-5, 5]}}\n") +
                  " -o " + folder);
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("goal missed"));
  EXPECT_THAT(run.out, HasSubstr("mm along the curve"));
  EXPECT_THAT(run.out, HasSubstr("the bounds allow"));
  EXPECT_TRUE(fs::exists(folder + "/result.json"));
}

/// The halves of the shape mirror each other, so other cells do not make it uneven.
TEST(Program, SaysWhereTiedTiltsMissTheTarget) {
  const Scratch scratch;
  const std::string text =
      "kinetix: 1\nname: tied\ntarget: {kind: curve, points: [[0, 0], [20, 10], [45, 12], [70, 0], [95, "
      "-12], "
      "[120, -10], [140, 0]]}\nstructure: {cells: [12, 1], cell_mm: 14}\nsolver: {starts: 2}\ntolerance: "
      "{shape: 0.02}\n";
  const auto said = [&](const std::string& beta) {
    return kinetix_opt(scratch.write("tied.yaml", text + beta) + " --no-verify -o " +
                       std::string(scratch / "out"));
  };
  EXPECT_EQ(said("").code, 0);
  const Outcome tied = said("variables: {beta: {symmetry: mirror_x}}\n");
  EXPECT_EQ(tied.code, 3) << tied.out;
  EXPECT_THAT(tied.out, HasSubstr("`symmetry` makes tilts depend on each other"));
  EXPECT_THAT(tied.out, HasSubstr("With `variables.beta.symmetry: none` the goal is met"));
}

TEST(Program, EndsWith4WhenThePhysicsRunDoesNotAgree) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(
      scratch.write("bow.yaml", std::string(bow) + "tolerance: {verify: 1e-15}\n") + " -o " + scratch.path());
  EXPECT_EQ(run.code, 4) << run.out;
  EXPECT_THAT(run.out, HasSubstr("simulation disagrees"));
}

TEST(Program, RunsAStructureOfNoExactFamilyByPhysicsAlone) {
  const Scratch scratch;
  const std::string design =
      scratch.write("loose.yaml",
                    "kinetix: 1\nstructure: {cells: [2, 2], cell_mm: 10}\n"
                    "design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.55}]}\n");
  const Outcome exact = kinetix_opt("simulate " + design + " -o " + scratch.path());
  EXPECT_EQ(exact.code, 2);
  EXPECT_FALSE(fs::exists(scratch / "result.json"));
  EXPECT_THAT(exact.err, HasSubstr("no exact family: hinge"));
  const Outcome physics = kinetix_opt("simulate " + design + " --model bullet --json -o " + scratch.path());
  EXPECT_TRUE(physics.code == 0 || physics.code == 4) << physics.err;
  const Json result = Json::parse(physics.out);
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_TRUE(result["metrics"]["verify_rms"].is_null());
}

TEST(Program, RunsASheetExactlyThoughItsCreasesCrossAtACorner) {
  const Scratch scratch;
  const std::string design = scratch.write(
      "corner.yaml",
      "kinetix: 1\nstructure: {cells: [[1, 0], [1, 1], [0, 1]]}\ndesign:\n  theta_deg: 40\n  hinges:\n"
      "    - {wall: [[1, 0], [2, 0]], beta_deg: -10}\n    - {wall: [[1, 1], [2, 1]], beta_deg: 10}\n"
      "    - {wall: [[1, 2], [2, 2]], beta_deg: -10}\n    - {wall: [[1, 0], [1, 1]], beta_deg: 20}\n"
      "    - {wall: [[2, 0], [2, 1]], beta_deg: -20}\n");
  const Outcome exact = kinetix_opt("simulate " + design + " --model exact --json -o " + scratch.path());
  ASSERT_EQ(exact.code, 3) << "two walls overlap from 37.7 degrees on. " << exact.err;
  const Json result = Json::parse(exact.out);
  EXPECT_EQ(result["plan"]["family"], "F4");
  EXPECT_NEAR(result["states"][0]["theta_rad"].get<double>(), 40 * std::acos(-1.0) / 180, 1e-12);
  EXPECT_LE(result["states"][0]["hinge_gap_max"].get<double>(), 1e-13);
}

TEST(Program, FollowsTheDriveOfADesign) {
  const Scratch scratch;
  const std::string strip =
      "kinetix: 1\nstructure: {cells: [6, 1], cell_mm: 10}\ndesign:\n  hinges:\n"
      "    - {wall: [[0, 0], [1, 0]], beta_deg: 20}\n    - {wall: [[0, 1], [1, 1]], beta_deg: -20}\n";
  const auto driven = [&](const std::string& drive) {
    return kinetix_opt("verify " + scratch.write("d.yaml", strip + "drive: " + drive + "\n") + " --json -o " +
                       scratch.path());
  };
  const Outcome hinge = driven("{kind: hinge, wall: [[0, 0], [0, 1]], angle_deg: -40}");
  EXPECT_EQ(hinge.code, 0) << hinge.err;
  EXPECT_NEAR(Json::parse(hinge.out)["metrics"]["theta_rad"], 20 * M_PI / 180, 1e-9);
  const Outcome plates = driven("{kind: plates, axis: y, compression: 0.15}");
  EXPECT_EQ(plates.code, 0) << plates.err;
  EXPECT_NEAR(Json::parse(plates.out)["metrics"]["theta_rad"], std::acos(0.85), 1e-9);
  const Outcome rolling = driven("{kind: plates, axis: x, compression: 0.15}");
  EXPECT_EQ(rolling.code, 2);
  EXPECT_THAT(rolling.err, HasSubstr("drive.axis: this sheet bends along x"));
}

TEST(Program, WritesAllOfItsFilesOrNoneWhenTheDiskIsFull) {
  const Scratch scratch;
  const std::string target = scratch.write("bow.yaml", bow), folder = scratch / "out";
  // The limit leaves space for the design but not for the report.
  const std::string full_disk = "ulimit -f 64; ";
  const Outcome first = kinetix_opt(target + " --no-verify -o " + folder, full_disk);
  EXPECT_EQ(first.code, 2) << first.out;
  EXPECT_THAT(first.err, HasSubstr("report.html: cannot be written: File too large"));
  EXPECT_FALSE(fs::exists(folder));

  ASSERT_EQ(kinetix_opt(target + " --no-verify -o " + folder).code, 0);
  const std::string design = text_of(folder + "/design.yaml"), result = text_of(folder + "/result.json");
  const std::string other =
      scratch.write("other.yaml", std::string(bow) + "variables: {theta: {range_deg: [5, 20]}}\n");
  EXPECT_EQ(kinetix_opt(other + " --no-verify -o " + folder, full_disk).code, 2);
  EXPECT_EQ(text_of(folder + "/design.yaml"), design);
  EXPECT_EQ(text_of(folder + "/result.json"), result);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 4)
      << "with .kinetix-files";
}

TEST(Program, RefusesOptionsOfASearchBeforeACommand) {
  const Scratch scratch;
  const std::string design = scratch.write("d.yaml", "kinetix: 1\nstructure: {cells: [4, 1]}\n"),
                    out = " -o " + std::string(scratch / "out");
  for (const char* given : {"--no-verify", "--monte-carlo 5", "goal.yaml"}) {
    const Outcome run = kinetix_opt(std::string(given) + " verify " + design + out);
    EXPECT_EQ(run.code, 2) << given;
    EXPECT_THAT(run.err, HasSubstr("only applies to a search, not to verify. Remove it (see --help)"));
    EXPECT_THAT(run.err, StartsWith(std::string(given).substr(0, 9)));
  }
  EXPECT_FALSE(fs::exists(scratch / "out"));
  EXPECT_EQ(kinetix_opt("--quiet --threads 1" + out + " --time-limit 60 simulate " + design).code, 0);
  EXPECT_TRUE(fs::exists(scratch / "out/result.json"));
  EXPECT_EQ(kinetix_opt("simulate " + design + " --time-limit 60 --quiet" + out + "2").code, 0);
}

TEST(Program, HelpNamesEveryCommandAndExitCode) {
  const Outcome help = kinetix_opt("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"verify", "simulate", "check", "--json", "--threads", "--seed", "--quiet",
                           "--version", "exit codes", "130 Ctrl-C", "TARGET.yaml"})
    EXPECT_THAT(help.out, HasSubstr(word));
  EXPECT_EQ(kinetix_opt("--version").out, "kinetix-opt " KINETIX_VERSION "\n");
}

struct BadInput {
  const char* name;
  const char* document;
  std::vector<std::string> says;
};

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

class RefusedInput : public ::testing::TestWithParam<BadInput> {};

TEST_P(RefusedInput, EndsWith2OneClearMessageAndNothingWritten) {
  const Scratch scratch;
  const std::string file = scratch.write("target.yaml", GetParam().document), folder = scratch / "out";
  const Outcome run = kinetix_opt(file + " -o " + folder);
  EXPECT_EQ(run.code, 2) << run.out;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, StartsWith(file + ":"));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const std::string& words : GetParam().says) EXPECT_THAT(run.err, HasSubstr(words));
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_EQ(kinetix_opt("check " + file).code, 2);
}

INSTANTIATE_TEST_SUITE_P(
    Program, RefusedInput,
    ::testing::Values(
        BadInput{"missing_curve",
                 "kinetix: 1\ntarget: {kind: curve, points: no.csv}\n",
                 {":2:", "target.points", "no.csv"}},
        BadInput{"two_points",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [9, 9]]}\n",
                 {"at least 3 points"}},
        BadInput{"repeated_point",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [9, 9], [9, 9]]}\n",
                 {"at least 3 points"}},
        BadInput{"nan",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [9, .nan], [20, 0]]}\n",
                 {":2:", "finite"}},
        BadInput{"crossing",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [9, 9], [9, 0], [0, 9]]}\n",
                 {"crosses itself"}},
        BadInput{"closed",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [9, 9], [9, 0], [0, 0]]}\n",
                 {"closed"}},
        BadInput{
            "huge_cell",
            "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [1, 1], [2, 0]]}\nstructure: {cell_mm: 50}\n",
            {"structure.cell_mm", "millimetres"}},
        BadInput{"bounds_upside_down",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [50, 50], [90, 0]]}\nvariables: {beta: "
                 "{range_deg: [60, -60]}}\n",
                 {":3:", "variables.beta.range_deg"}},
        BadInput{"units",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [50, 50], [90, 0]]}\nstructure: "
                 "{cell_mm: 8 cm}\n",
                 {":3:", "structure.cell_mm", "mm"}},
        BadInput{"unknown_key",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [50, 50], [90, 0]]}\nstructur: {}\n",
                 {":3:1:", "structur", "structure"}},
        BadInput{"alias_bomb", "a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n", {":1:", "anchor"}},
        BadInput{"other_version",
                 "kinetix: 2\ntarget: {kind: curve, points: [[0, 0], [50, 50], [90, 0]]}\n",
                 {":1:", "kinetix"}},
        BadInput{"theta_past_closing",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [50, 50], [90, 0]]}\nvariables: {theta: "
                 "{range_deg: [44, 44.5]}}\n",
                 {":3:", "variables.theta", "close"}},
        BadInput{"thick_walls",
                 "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [50, 50], [90, 0]]}\nstructure: "
                 "{cell_mm: 8, wall_mm: {thickness: 5}}\n",
                 {":3:", "thickness"}}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(Program, RefusesAMissingFileAFolderAndAnUnwritableOutput) {
  const Scratch scratch;
  EXPECT_EQ(kinetix_opt("nowhere.yaml").code, 2);
  EXPECT_EQ(kinetix_opt(scratch.path()).code, 2);
  const std::string target = scratch.write("bow.yaml", bow);
  const Outcome run = kinetix_opt(target + " -o " + target + "/below");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("below"));
  EXPECT_EQ(kinetix_opt(target + " --threads -3").code, 2);
  EXPECT_EQ(kinetix_opt("--nonsense").code, 2);
}

TEST(Program, ErrorsAreJsonWhereJsonIsAsked) {
  const Scratch scratch;
  const std::string target = scratch.write("bow.yaml", std::string(bow) + "tolerance: {shap: 1}\n");
  const Outcome run = kinetix_opt(target + " --json -o " + (scratch / "out").string());
  EXPECT_EQ(run.code, 2);
  const Json error = Json::parse(run.out)["error"];
  EXPECT_EQ(error["exit_code"], 2);
  EXPECT_EQ(error["file"], target);
  EXPECT_EQ(error["line"], 5);
  EXPECT_EQ(error["column"], 13);
  EXPECT_EQ(error["message"].get<std::string>() + "\n", run.err);
  EXPECT_THAT(run.err, EndsWith(error["reason"].get<std::string>() + "\n"));

  const Outcome unknown = kinetix_opt(target + " --json --jsom");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(Json::parse(unknown.out)["error"]["message"].get<std::string>(), HasSubstr("--jsom"));
}

TEST(Program, RunsOfCoarserStepsComeWhenAsked) {
  const Scratch scratch;
  const std::string target = scratch.write("bow.yaml", bow), folder = scratch / "out";
  const auto rows = [&](const std::string& more) {
    EXPECT_EQ(kinetix_opt(target + " -o " + folder + more).code, 0);
    return Json::parse(text_of(folder + "/result.json"))["fidelity"].size();
  };
  EXPECT_EQ(rows(""), 2u) << "the closed form and its one physics run";
  EXPECT_EQ(rows(" --fidelity"), 4u);
}

TEST(Program, ShowsTheReportWhenAsked) {
  const Scratch scratch;
  const std::string opened = scratch / "opened";
  fs::permissions(scratch.write("xdg-open", "#!/bin/sh\nprintf %s \"$1\" >" + opened + ".part\nmv " + opened +
                                                ".part " + opened + "\n"),
                  fs::perms::owner_all);
  const std::string folder = scratch / "out", path = std::getenv("PATH");
  setenv("PATH", (scratch.path() + ":" + path).c_str(), 1);
  const Outcome run = kinetix_opt(scratch.write("bow.yaml", bow) + " --no-verify --open -o " + folder);
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(run.code, 0) << run.err;
  for (int k = 0; k < 500 && !fs::exists(opened); ++k) usleep(10'000);
  EXPECT_EQ(text_of(opened), folder + "/report.html");
}

}  // namespace
}  // namespace kinetix::testing
