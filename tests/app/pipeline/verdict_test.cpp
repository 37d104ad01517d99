#include "app/result/verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using VerdictJson = nlohmann::json;
using app::RunVerdict;

constexpr const char* flag_names[] = {"met", "agrees", "printable", "reaches"};

bool is_false(const VerdictJson& flag) { return flag == false; }

/// Checks rules of every verdict: errors if flags are false, a kind of hinge for each flag, and the exit code.
void expect_consistent(const VerdictJson& verdict, int code, const std::string& who) {
  bool any_false = false;
  for (const char* name : flag_names) {
    any_false |= is_false(verdict[name]);
    EXPECT_EQ(verdict["hinges"].contains(name), !verdict[name].is_null()) << who << " " << name;
  }
  bool has_error = false;
  for (const VerdictJson& problem : verdict["problems"]) has_error |= problem["level"] == "error";
  EXPECT_EQ(has_error, any_false) << who << verdict.dump(1);
  const bool missed =
      is_false(verdict["met"]) || is_false(verdict["printable"]) || is_false(verdict["reaches"]);
  EXPECT_EQ(code, missed ? 3 : is_false(verdict["agrees"]) ? 4 : 0) << who << verdict.dump(1);
}

struct Judged {
  Outcome run;
  VerdictJson result;
  const VerdictJson& verdict() const { return result["verdict"]; }
};

/// Runs the program and checks its verdict.
Judged judged(const std::string& command, const std::string& folder) {
  Judged out;
  out.run = kinetix_opt(command + " --quiet --json -o " + folder);
  out.result = VerdictJson::parse(out.run.out);
  EXPECT_EQ(schema_errors(VerdictJson::parse(out.run.out)), "") << command;
  expect_consistent(out.verdict(), out.run.code, command);
  return out;
}

std::string errors_of(const VerdictJson& verdict) {
  std::string out;
  for (const VerdictJson& problem : verdict["problems"])
    if (problem["level"] == "error") out += problem["text"].get<std::string>() + "\n";
  return out;
}

/// Returns the shipped handle with three times as many cells. Its walls are too thin to print.
std::string thin_handle() {
  return "kinetix: 1\ntarget: {kind: space_curve, points: " KINETIX_SOURCE
         "/targets/shapes/handle.csv}\nstructure: {cells: [60, 1]}\ntolerance: {shape: 0.005}\n";
}

TEST(Verdict, HasAnErrorWhereAFlagIsFalseAndNowhereElse) {
  RunVerdict verdict;
  verdict.set(&RunVerdict::met, {}, "pin");
  EXPECT_EQ(verdict.met, true);
  verdict.warn("walls may touch");
  EXPECT_FALSE(verdict.has_errors());
  EXPECT_EQ(exit_code(verdict), app::done);
  verdict.set(&RunVerdict::reaches, {"locked"}, "pin");
  EXPECT_EQ(verdict.reaches, false);
  EXPECT_TRUE(verdict.has_errors());
  EXPECT_EQ(verdict.reasons(), "locked");
}

TEST(Verdict, ThreeGoesBeforeFourAndWhatWasNotAskedCountsForNothing) {
  const std::optional<bool> none, yes = true, no = false;
  for (const auto& met : {none, yes, no})
    for (const auto& agrees : {none, yes, no})
      for (const auto& printable : {none, yes, no})
        for (const auto& reaches : {none, yes, no}) {
          const RunVerdict verdict{.met = met,
                                   .agrees = agrees,
                                   .printable = printable,
                                   .reaches = reaches,
                                   .hinges = {},
                                   .problems = {}};
          const int expected = met == no || printable == no || reaches == no ? 3 : agrees == no ? 4 : 0;
          EXPECT_EQ(exit_code(verdict), expected);
        }
}

// Sheets of three kinds that `export` refuses, and walls thinner than the process prints.
TEST(Verdict, OfASheetThatExportRefusesIsThree) {
  const Scratch scratch;
  const std::string
      letter = scratch.write(
          "letter.yaml",
          "kinetix: 1\ntarget: {kind: display, glyph: S}\nstructure: {cells: [10, 10], cell_mm: 10}\n"
          "drive: {kind: hinge}\n"),
      star = scratch.write(
          "star.yaml",
          "kinetix: 1\ntarget: {kind: outline, points: [[90, 0], [12, 18], [-60, 75], [-24, "
          "0], [-75, -90], [12, "
          "-18]]}\nstructure: {cells: [5, 5], trim: none}\ntolerance: {shape: 0.2, iou: 0.2}\n"),
      handle = scratch.write("handle.yaml", thin_handle());
  const std::string thin = scratch.write(
      "thin.yaml",
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n"
      "structure: {cells: [12, 1], wall_mm: {thickness: 0.4, height: 6}}\n");
  for (const std::string& file : {letter, star, handle, thin}) {
    const std::string out = scratch / fs::path(file).stem().string(), print = out + "_print";
    const Judged found = judged(file + " --no-verify", out);
    EXPECT_EQ(found.verdict()["met"], true) << file;
    EXPECT_EQ(found.verdict()["agrees"], nullptr) << file;
    EXPECT_EQ(found.verdict()["printable"], false) << file;
    const Outcome refused = kinetix_opt("export " + out + " --format stl --quiet -o " + print);
    EXPECT_EQ(refused.code, 3) << refused.err;
    EXPECT_FALSE(fs::exists(print)) << "nothing is written";
  }
}

// The verdict names the hinges of `export`: pins if they fit, otherwise blocks, or the hinges of the file.
TEST(Verdict, OfASheetThatExportWritesNamesItsHinges) {
  const Scratch scratch;
  const std::string curve =
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n";
  for (const char* more : {"structure: {cells: [12, 1]}\n", "structure: {cells: [12, 1], cell_mm: 20}\n",
                           "structure: {cells: [12, 1]}\nhinge: {kind: block, material: tango, gap_mm: 1.5}\n"
                           "drive: {kind: shape_memory, k_turn: 5}\n"}) {
    const std::string out = scratch / "out", print = scratch / "print";
    const Judged found = judged(scratch.write("in.yaml", curve + more) + " --no-verify", out);
    const Outcome made = kinetix_opt("export " + out + " --format stl --quiet -o " + print);
    EXPECT_EQ(found.verdict()["printable"], made.code == 0) << more << made.err;
    if (made.code != 0) continue;
    EXPECT_EQ(found.verdict()["hinges"]["printable"],
              VerdictJson::parse(text_of(print + "/print.json"))["hinge"]);
  }
}

/// Runs panels that miss their goals, and checks what is reported of those whose walls lock during the motion.
void expect_missed_panels(const std::vector<std::string>& panels) {
  const Scratch scratch;
  int stopped = 0;
  for (const std::string& more : panels) {
    const Judged found = judged(scratch.write("in.yaml", "kinetix: 1\n" + more), scratch / "out");
    EXPECT_EQ(found.verdict()["met"], false) << more << found.verdict().dump(1);
    EXPECT_EQ(found.result["metrics"]["met"], false) << more;
    if (found.verdict()["reaches"] == true) continue;
    ++stopped;
    EXPECT_THAT(errors_of(found.verdict()), HasSubstr("the drive stops before the fold")) << more;
    EXPECT_THAT(found.result["display"]["reasons"].dump(), HasSubstr("the drive stops before the fold"))
        << more;
  }
  EXPECT_GE(stopped, 1);
}

/// The first panel locks. The second one is too small for its letter.
TEST(Verdict, AGoalIsNotMetWhereTheDriveNeverArrives) {
  expect_missed_panels(
      {"target: {kind: display, glyph: L}\nstructure: {lattice: honeycomb, cells: [5, 4]}\n"
       "drive: {compression: 0.26}\n",
       "target: {kind: display, glyph: H}\nstructure: {lattice: honeycomb, cells: [6, 4]}\n"});
}

TEST(VerdictSoak, GoalsOfLargerPanelsAreNotMetWhereTheDriveNeverArrives) {
  const std::string further = "drive: {compression: 0.185}\n";
  expect_missed_panels(
      {"target: {kind: display, glyph: H}\nstructure: {lattice: honeycomb, cells: [8, 8]}\n" + further,
       "target: {kind: display, glyph: L}\nstructure: {lattice: honeycomb, cells: [8, 8]}\n" + further,
       "target: {kind: display, glyph: T}\nstructure: {lattice: honeycomb, cells: [7, 7]}\n" + further,
       "target: {kind: display, glyph: E}\nstructure: {lattice: honeycomb, cells: [8, 7]}\n" + further});
}

TEST(Verdict, OfForwardRunsAsksNothingOfPrints) {
  const Scratch scratch;
  const std::string design = scratch.write("design.yaml",
                                           "kinetix: 1\nstructure: {cells: [4, 2], cell_mm: 10}\n"
                                           "design: {theta_deg: 20}\n");
  for (const char* model : {"exact", "equilibrium", "bullet"}) {
    const Judged found = judged("simulate " + design + " --model " + model, scratch / model);
    EXPECT_EQ(found.run.code, 0) << model;
    EXPECT_EQ(found.verdict()["met"], nullptr);
    EXPECT_EQ(found.verdict()["printable"], nullptr);
    EXPECT_EQ(found.verdict()["reaches"], true) << model;
    EXPECT_EQ(found.verdict()["agrees"].is_null(), std::string(model) != "bullet");
  }
  const Judged beyond = judged("simulate " + design + " --theta-deg 44.9", scratch / "beyond");
  EXPECT_EQ(beyond.run.code, 3) << "walls of real thickness meet before";
  EXPECT_EQ(beyond.verdict()["reaches"], false);
}

// A film with a strain beyond its material's limit, in an exact and in an elastic state.
TEST(Verdict, OfAStrainBeyondTheMaterialsIsThatTheDriveDoesNotReach) {
  const Scratch scratch;
  const std::string design =
      scratch.write("design.yaml",
                    "kinetix: 1\nstructure: {cells: [4, 2], cell_mm: 20}\n"
                    "design: {theta_deg: 30}\n"
                    "hinge: {kind: film, material: pa12, gap_mm: 1, thickness_mm: 0.4}\n");
  for (const char* model : {"exact", "equilibrium"}) {
    const Judged found = judged("simulate " + design + " --model " + model, scratch / model);
    EXPECT_EQ(found.run.code, 3) << model;
    EXPECT_EQ(found.verdict()["reaches"], false) << model;
    EXPECT_EQ(found.verdict()["hinges"]["reaches"], "film");
    EXPECT_THAT(errors_of(found.verdict()), HasSubstr("strained")) << model;
  }
}

TEST(Verdict, StandsFirstInTheSummary) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(scratch.write("handle.yaml", thin_handle()) + " --no-verify --quiet -o " +
                                  (scratch / "out").string());
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.out.substr(0, run.out.find('\n')), "handle: goal met, not printable");
  EXPECT_THAT(run.out, HasSubstr("with blocks a wall of 0.337 mm is below the minimum of polyjet, 0.6 mm"));
}

}  // namespace
}  // namespace kinetix::testing
