#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/sweep/sweep.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;

// A valid factor for files with errors elsewhere.
const std::string theta = "  - {path: design.theta_deg, range: [5, 40], levels: 8}\n";

struct Bad {
  std::string doe;
  std::string says;
};

// Invalid sweep files, and the required part of each message.
const Bad bad_sweeps[] = {
    {sweep_of("{kind: factorial}", "  - {path: design.tetha_deg, range: [5, 40]}\n", "end_mm"),
     "doe.yaml:6:5: factors[0]: the base has no number at `design.tetha_deg`. Did you "
     "mean `design.theta_deg`?"},
    {sweep_of("{kind: factorial}", "  - {path: \"design.hinges[*].betas_deg\", range: [5, 40]}\n", "end_mm"),
     "Did you mean `design.hinges[*].beta_deg`?"},
    {sweep_of("{kind: factorial}", "  - {path: hinge.k_pont, range: [5, 40]}\n", "end_mm"),
     "Did you mean `hinge.k_point`?"},
    {sweep_of("{kind: factorial}", "  - {path: physics.iterations, range: [5, 40]}\n", "end_mm"),
     "`physics.iterations` was removed"},
    {sweep_of("{kind: factorial}", "  - {path: \"design.hinges[2].t\", range: [0.2, 0.4]}\n", "end_mm"),
     "no such entry. Count positions from 0"},
    {sweep_of("{kind: factorial}", "  - {path: \"design.hinges[x].t\", range: [0.2, 0.4]}\n", "end_mm"),
     "is not a path"},
    {sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [5, 140]}\n", "end_mm"),
     "design.theta_deg = 140: 140 is out of range. Give a number above -90 and below 90"},
    {sweep_of("{kind: factorial}", "  - {path: \"design.columns[*].t\", range: [0, 0.4]}\n", "end_mm"),
     "0 is out of range"},
    {sweep_of("{kind: factorial}", "  - {path: hinge.k_point, range: [-1, 40]}\n", "end_mm"),
     "hinge.k_point: `-1`"},
    {sweep_of("{kind: factorial}", "  - {path: design.theta_deg, range: [40, 5]}\n", "end_mm"), "reversed"},
    {sweep_of("{kind: factorial}", "  - {path: design.theta_deg}\n", "end_mm"),
     "Give exactly one of `range:"},
    {sweep_of("{kind: factorial}", "  - {path: design.theta_deg, normal: {mean: 20, sd: 0}}\n", "end_mm"),
     "sd"},
    {sweep_of("{kind: factorial}", theta + theta, "end_mm"), "two factors have the name `design.theta_deg`"},
    {sweep_of("{kind: factorial}",
              "  - {path: \"design.walls[0].t\", range: [0.2, 0.4]}\n"
              "  - {path: \"design.hinges[0].t\", range: [0.2, 0.4]}\n",
              "end_mm"),
     "another factor already varies this number"},
    {sweep_of("{kind: factorial}", "  - {path: \"structure.cells[0]\", values: [4, 6]}\n",
              "end_mm, moved_rms_mm"),
     "compares bodies with those of the base, and their number varies with `structure.cells`"},
    {sweep_of("{kind: factorial}",
              "  - {path: \"design.walls[*].t\", name: place, range: [0.4, 0.6], each: true}\n", "end_mm"),
     "names one column, and `each: true` makes several"},
    {sweep_of("{kind: one_at_a_time}", "  - {path: hinge.k_turn, range: [0.2, 2]}\n", "end_mm"),
     "`one_at_a_time` starts from the base, which has no single value here"},
    {sweep_of("{kind: one_at_a_time}",
              "  - {path: [\"design.hinges[0].beta_deg\", \"design.hinges[1].beta_deg\"], range: [5, 9]}\n",
              "end_mm"),
     "which has no single value"},
    {sweep_of("{kind: sobol, samples: 1000000000000}", theta, "end_mm"), "method.samples"},
    {sweep_of("{kind: sobol, samples: 1.5}", theta, "end_mm"), "whole number"},
    {sweep_of("{kind: factorial, levels: 1000000}",
              "  - {path: design.theta_deg, range: [5, 40]}\n  - {path: \"design.columns[0].t\", range: "
              "[0.2, 0.4]}\n",
              "end_mm"),
     "1e+12 samples are too many. Give at most 10000000"},
    {sweep_of("{kind: sobal, samples: 8}", theta, "end_mm"), "did you mean `sobol`?"},
    {sweep_of("{kind: factorial}", theta, "end_m"), "did you mean `end_mm`?"},
    {sweep_of("{kind: factorial}", theta, "end_mm, end_mm"), "is listed twice"},
    {sweep_of("{kind: factorial}", theta, "energy_Nmm"), "is not a metric of this model"},
    {sweep_of("{kind: factorial}", theta, "shape_rms"), "Add `goal: FILE.yaml`"},
    {sweep_of("{kind: factorial}", theta, "end_mm", "modle: exact\n"), "did you mean `model`?"},
    {"kinetix: 1\nbase: missing.yaml\nmethod: {kind: factorial}\nfactors:\n" + theta +
         "responses: [end_mm]\n",
     "missing.yaml"},
    {"kinetix: 2\n", "version 2 is not supported"},
};

TEST(SweepBadInput, EndsWith2SaysWhatIsWrongAndWritesNothing) {
  for (const Bad& bad : bad_sweeps) {
    SCOPED_TRACE(bad.doe);
    const Scratch scratch;
    const Outcome run = run_sweep_in(scratch, bad.doe);
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.err, HasSubstr(bad.says));
    EXPECT_FALSE(fs::exists(scratch / "out"));
  }
}

TEST(SweepBadInput, CheckFindsItWithoutRunning) {
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const Outcome good =
      kinetix_opt("check " + scratch.write("good.yaml", sweep_of("{kind: factorial}", theta, "end_mm")));
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("valid sweep 'swept'"));
  const Outcome bad =
      kinetix_opt("check " + scratch.write("bad.yaml", sweep_of("{kind: factorial}", theta, "end_m")));
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.err, HasSubstr("did you mean `end_mm`?"));
}

TEST(SweepBadInput, AModelThatFitsNoSampleIsRefused) {
  const Scratch scratch;
  const std::string loose =
      "kinetix: 1\nstructure: {cells: [2, 2]}\ndesign: {theta_deg: 5, hinges: [{wall: [[0, 0], "
      "[1, 0]], t: 0.3}]}\n";
  const Outcome run = run_sweep_in(scratch, sweep_of("{kind: factorial}", theta, "end_mm"), "", loose);
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("Give `model: equilibrium` or `rigid_body`"));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST(SweepBadInput, AThetaThatADriveDecidesCannotBeAFactor) {
  const Scratch scratch;
  const Outcome run = run_sweep_in(scratch, sweep_of("{kind: factorial}", theta, "end_mm"), "",
                                   std::string(strip) + "drive: {kind: plates, compression: 0.1}\n");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("`drive` of the base sets the fold angle"));
}

TEST(SweepBadInput, ColumnsAreOfSquaresAlone) {
  const Scratch scratch;
  const Outcome run = run_sweep_in(
      scratch,
      sweep_of("{kind: factorial}", "  - {path: \"design.columns[0].t\", range: [0.4, 0.6]}\n", "end_mm"), "",
      "kinetix: 1\nstructure: {lattice: honeycomb, cells: [3, 2], cell_mm: 10}\ndesign: {theta_deg: 20}\n");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("the base has no number at `design.columns[0].t`. Did you mean `"));
}

TEST(SweepBadInput, WhatMeasuresDesignsIsRefusedWhereTheBaseIsATarget) {
  const Scratch scratch;
  const std::string flat = "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [40, 8], [80, 0]]}\n";
  scratch.write("other.yaml", flat);
  const std::string cell = "  - {path: structure.cell_mm, values: [10]}\n";
  const Outcome run =
      run_sweep_in(scratch, sweep_of("{kind: factorial}", cell, "shape_rms", "goal: other.yaml\n"), "",
                   flat + "structure: {cells: [8, 1], cell_mm: 10}\n");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("goal: only applies to designs"));
}

TEST(SweepBadInput, AFolderThatCannotBeWrittenIsNamed) {
  const Scratch scratch;
  scratch.write("strip.yaml", strip);
  const std::string doe = scratch.write("doe.yaml", sweep_of("{kind: factorial}", theta, "end_mm"));
  const Outcome run = kinetix_opt("sweep " + doe + " -o /proc/nowhere");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("/proc/nowhere: cannot create this output folder"));
}

// Regression: the names of all columns were compared with each other, which took a minute for a sheet of 100 x 100
// cells.
TEST(SweepBadInput, CountsItsColumnsBeforeItComparesThem) {
  const Scratch scratch;
  const Outcome run = run_sweep_in(
      scratch,
      sweep_of("{kind: monte_carlo, samples: 10}",
               "  - {path: \"design.walls[*].t\", range: [0.4, 0.6], each: true}\n", "moved_rms_mm"),
      "", "kinetix: 1\nstructure: {cells: [60, 60]}\ndesign: {theta_deg: 20}\n");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("factors and 1 responses are too many for a table. Give at most 1900"));
}

}  // namespace
}  // namespace kinetix::testing
