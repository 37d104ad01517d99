#include "app/console/short_form.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <random>
#include <sstream>

#include "app/run/plan.hpp"
#include "tests/app/bow.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using app::ShortForm;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Checks that an output has at most 7 lines of at most 100 columns.
void expect_short(const std::string& out, const std::string& name) {
  EXPECT_LE(lines_of(out).size(), app::most_lines) << name << "\n" << out;
  for (const std::string& line : lines_of(out)) {
    const auto columns = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
    EXPECT_LE(columns, static_cast<long>(app::most_columns)) << name << "\n" << line;
  }
}

ShortForm full_form() {
  ShortForm form{.title = "rib: goal met"};
  for (const char* label : {"shape", "size", "print", "force", "check"})
    form.lines.push_back({label, "1 mm"});
  form.ends = {"Report: results/rib/report.html", "Next: kinetix-opt export results/rib --format 3mf"};
  return form;
}

TEST(ShortForm, HasTheVerdictFirstAndTheNextCommandLast) {
  const std::vector<std::string> lines = lines_of(format_short(full_form()));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[0], "rib: goal met");
  EXPECT_EQ(lines[1], "  shape    1 mm");
  EXPECT_EQ(lines[5], "  check    1 mm");
  EXPECT_THAT(lines[6], StartsWith("Report: results/rib/report.html   Next: kinetix-opt export results/rib"));
}

TEST(ShortForm, ReplacesLinesByTheFirstProblem) {
  ShortForm form = full_form();
  form.problems = {{"error", std::string(40, 'a') + " " + std::string(70, 'b')}, {"warning", "c"}};
  const std::string out = format_short(form);
  expect_short(out, "two problems");
  const std::vector<std::string> lines = lines_of(out);
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[4], "  error:   " + std::string(40, 'a'));
  EXPECT_EQ(lines[5], "           " + std::string(70, 'b') + " (1 more with -v)");
  EXPECT_THAT(out, Not(HasSubstr("force")));
}

TEST(ShortForm, CutsALongProblemAndALongLine) {
  ShortForm form{.title = "rib: goal missed"};
  form.lines = {{"size", "flat 1 mm; " + std::string(90, 'x')}};
  std::string words;
  for (int k = 0; k < 80; ++k) words += "words ";
  form.problems = {{"warning", words}};
  const std::string out = format_short(form);
  expect_short(out, "long texts");
  EXPECT_THAT(out, HasSubstr("  size     flat 1 mm\n"));
  EXPECT_THAT(out, HasSubstr("... (all with -v)\n"));
  EXPECT_THAT(format_long(form), HasSubstr(words + "\n"));
}

TEST(ShortForm, PutsLongPathsOnLinesOfTheirOwn) {
  ShortForm form = full_form();
  form.ends = {"Report: " + std::string(60, 'r'), "Next: " + std::string(60, 'n')};
  const std::vector<std::string> lines = lines_of(format_short(form));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[5], form.ends[0]);
  EXPECT_THAT(lines[6], StartsWith(form.ends[1]));
}

TEST(ShortForm, FormatsNumbersWithThreeFigures) {
  const std::vector<std::pair<double, std::string>> expected = {
      {0.0247, "0.0247"}, {0.5, "0.5"}, {12.34, "12.3"},       {381.2, "381"}, {1024.4, "1024"},
      {0.0, "0"},         {100, "100"}, {1e-9, "under 0.001"}, {-2.5, "-2.5"}};
  for (const auto& [value, text] : expected) EXPECT_EQ(app::format_figures(value), text);
}

TEST(ShortForm, ColoursSeveritiesAndTheVerdict) {
  EXPECT_EQ(app::coloured("rib: goal met\n"), "\033[32mrib: goal met\033[0m\n");
  EXPECT_EQ(app::coloured("rib: goal met\n  warning: w\n"),
            "\033[33mrib: goal met\033[0m\n  \033[33mwarning:\033[0m w\n");
  EXPECT_THAT(app::coloured("rib: goal missed\n  error:   e\n  warning: w\n"),
              StartsWith("\033[31mrib: goal missed\033[0m\n"));
}

TEST(ShortForm, IsInColourOnlyOnATerminalWithoutNoColor) {
  EXPECT_TRUE(app::uses_colour(true, nullptr));
  EXPECT_TRUE(app::uses_colour(true, ""));
  EXPECT_FALSE(app::uses_colour(true, "1"));
  EXPECT_FALSE(app::uses_colour(false, nullptr));
}

class ShippedOutput : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedOutput, HasSevenLinesOfAHundredColumns) {
  const Scratch scratch;
  const std::string name = GetParam(),
                    file = std::string(KINETIX_SOURCE) + "/targets/shapes/" + name + ".yaml";
  const Outcome run = short_run(file + " --quiet -o " + std::string(scratch / name));
  EXPECT_TRUE(run.code == 0 || run.code == 3) << run.err;
  expect_short(run.out, name);
  const std::vector<std::string> lines = lines_of(run.out);
  ASSERT_GE(lines.size(), 4u) << run.out;
  EXPECT_THAT(lines[0], StartsWith(name + ": goal "));
  EXPECT_THAT(run.out, HasSubstr("\n  size     flat "));
  EXPECT_THAT(run.out, HasSubstr("Next: "));
  EXPECT_THAT(run.out, Not(HasSubstr("\033"))) << "no colours without a terminal";
  expect_short(short_run("check " + file).out, name + ", checked");
}

INSTANTIATE_TEST_SUITE_P(Shapes, ShippedOutput,
                         ::testing::Values("helmet_rib", "half_circle", "s_curve", "letter_t", "rubber_t",
                                           "cube", "tetrahedron", "disc", "shrinking_block", "tray_in_mm"));

TEST(ShortOutput, HasTheLongFormWithV) {
  const Scratch scratch;
  const std::string target = scratch.write("bow.yaml", bow), folder = scratch / "out";
  const Outcome brief = short_run(target + " --quiet -o " + folder),
                verbose = short_run(target + " --quiet --verbose -o " + folder);
  expect_short(brief.out, "bow");
  EXPECT_THAT(brief.out, HasSubstr("Report: " + folder + "/report.html"));
  EXPECT_GT(lines_of(verbose.out).size(), 9u) << verbose.out;
  EXPECT_EQ(lines_of(brief.out)[0], lines_of(verbose.out)[0]) << "the same verdict";
  EXPECT_THAT(verbose.out, HasSubstr("\n  search "));
  for (const char* command : {"verify ", "simulate ", "simulate --model equilibrium ", "check "})
    expect_short(short_run(command + folder + " --quiet" +
                           (std::string(command) == "check " ? "" : " -o " + folder + "_2"))
                     .out,
                 command);
  expect_short(short_run("export " + folder + " --quiet --format stl -o " + folder + "_print").out, "export");
}

TEST(ShortOutput, NamesProblemsByTheirSeverity) {
  const Scratch scratch;
  const Outcome missed =
      short_run(scratch.write("bow.yaml", std::string(bow) + "tolerance: {shape: 1e-9}\n") +
                " --quiet --no-verify -o " + std::string(scratch / "out"));
  EXPECT_EQ(missed.code, 3);
  EXPECT_THAT(missed.out, StartsWith("bow: goal missed"));
  EXPECT_THAT(missed.out, HasSubstr("\n  error:   "));
  EXPECT_THAT(missed.out, HasSubstr("Next: change the file, run again"));
  expect_short(missed.out, "missed");
}

// A thin arch of 200 x 100 x 4 mm in any orientation has these edges.
TEST(SmallestBox, DoesNotDependOnTheFrame) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Matrix3d axes = Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random))
                                     .normalized()
                                     .toRotationMatrix();
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k <= 400; ++k)
      for (const double side : {-2.0, 2.0}) {
        const double angle = pi * k / 400;
        points.emplace_back(axes * Eigen::Vector3d(100 * std::cos(angle), side, 100 * std::sin(angle)));
      }
    const Eigen::Vector3d edges = app::smallest_box(points);
    EXPECT_NEAR(edges[0], 200, 0.3);
    EXPECT_NEAR(edges[1], 100, 0.3);
    EXPECT_NEAR(edges[2], 4, 0.3) << trial;
  }
}

}  // namespace
}  // namespace kinetix::testing
