#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using std::string_literals::operator""s;
using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* made_arc = R"(kinetix: 1
name: arc
target: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}
structure: {cells: [12, 1]}
)";

struct Printed {
  Json result;
  std::string out;
};

Printed printed(const Scratch& scratch, const std::string& process, int code = 0) {
  const std::string folder = scratch / "out";
  const Outcome run =
      kinetix_opt(scratch.write("arc.yaml", made_arc + process) + " -o " + folder + " --no-verify");
  EXPECT_EQ(run.code, code) << run.out << run.err;
  return {Json::parse(text_of(folder + "/result.json")), run.out};
}

TEST(AsMadeResult, SaysWhatPrintsComeTo) {
  const Scratch scratch;
  const Printed usual = printed(scratch, "");
  EXPECT_EQ(schema_errors(usual.result), "");
  const Json& made = usual.result["as_made"];
  EXPECT_EQ(made["process"], "polyjet");
  EXPECT_THAT(usual.out, HasSubstr("print tolerance (polyjet, estimated): "));
  EXPECT_EQ(usual.result["metrics"]["as_made_rms_mm"], made["rms_mm"]);
  EXPECT_GT(made["rms_mm"], made["designed_mm"]);
  EXPECT_GT(made["p95_mm"], made["rms_mm"]);
  EXPECT_EQ(made["holds"], made["p95_mm"].get<double>() <= made["tolerance_mm"].get<double>());
  EXPECT_EQ(made["sources"].size(), 10u);
}

TEST(AsMadeResult, IsConfirmedByPrints) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("arc.yaml", made_arc) + " -o " + folder +
                                  " --no-verify --hinge block --monte-carlo 500");
  ASSERT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("500 simulated prints: "));
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  const Json& made = result["as_made"];
  EXPECT_EQ(made["prints"]["failed"], 0);
  EXPECT_EQ(made["prints"]["kept"], 475) << "19 of 20, which pages do not count for themselves";
  EXPECT_NEAR(made["prints"]["rms_mm"], made["rms_mm"].get<double>(), 0.1 * made["rms_mm"].get<double>());
  EXPECT_NEAR(made["prints"]["p95_mm"], made["p95_mm"].get<double>(), 0.1 * made["p95_mm"].get<double>());
}

// A print of a flat strip is as uneven as one of a strip that rises by a ten thousandth of its length.
TEST(AsMadeResult, OfAFlatStripCountsWhatBendsItOutOfItsPlane) {
  const auto made = [](const std::string& middle) {
    const Scratch scratch;
    const std::string file =
        scratch.write("strip.yaml", "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [50, " + middle +
                                        "], [100, 0]]}\n");
    const Outcome run =
        kinetix_opt(file + " -o " + std::string(scratch / "out") + " --no-verify --hinge block");
    EXPECT_TRUE(run.code == 0 || run.code == 3) << run.err;
    return Json::parse(text_of(scratch / "out/result.json"))["as_made"];
  };
  const Json flat = made("0"), risen = made("0.01");
  EXPECT_GT(risen["rms_mm"], 0.02);
  EXPECT_NEAR(flat["rms_mm"], risen["rms_mm"].get<double>(), 0.2 * risen["rms_mm"].get<double>());
  EXPECT_NEAR(flat["prints"]["rms_mm"], flat["rms_mm"].get<double>(), 0.3 * flat["rms_mm"].get<double>());
  EXPECT_EQ(flat["holds"], risen["holds"]);
}

// To first order, errors add to rms^2 in proportion to the square of their standard deviations.
TEST(AsMadeResult, GrowsWithTheErrorsOfTheProcess) {
  const Scratch scratch;
  const auto added = [](const Json& made) {
    const double rms = made["rms_mm"], designed = made["designed_mm"];
    return rms * rms - designed * designed;
  };
  const Json
      one = printed(scratch, "process: {base: fdm, sd: {t_mm: 0.05, tilt_deg: 0.25}}\n", 3).result["as_made"],
      two = printed(scratch, "process: {base: fdm, sd: {t_mm: 0.1, tilt_deg: 0.5}}\n", 3).result["as_made"];
  EXPECT_EQ(one["process"], "fdm");
  EXPECT_THAT(text_of(scratch / "out/design.yaml"), HasSubstr("process: {base: fdm, sd: {t_mm: 0.1}}\n"))
      << "what differs from its base";
  EXPECT_NEAR(added(two), 4 * added(one), 1e-6 * added(two));
  const Printed rough = printed(scratch, "process: {sd: {tilt_deg: 5}}\n");
  EXPECT_EQ(rough.result["as_made"]["holds"], false);
  EXPECT_THAT(rough.out, HasSubstr("not every print stays within it"));
}

TEST(AsMadeResult, NamesPlacesThatCountMost) {
  const Scratch scratch;
  const Printed one = printed(scratch, "");
  const Json& places = one.result["as_made"]["places"];
  ASSERT_FALSE(places.empty());
  EXPECT_LE(places.size(), 10u);
  EXPECT_THAT(places[0]["place"].get<std::string>(), ::testing::StartsWith("column "));
  EXPECT_GE(places[0]["share"], one.result["as_made"]["sources"][0]["share"])
      << "a column has several hinges";
  EXPECT_GE(places[0]["share"], places[1]["share"]);
  EXPECT_THAT(one.out, HasSubstr(" in " + places[0]["place"].get<std::string>() + ", "));
}

TEST(AsMadeResult, NotesBeforeTheSearchWhatTheUsualProcessCannotPrint) {
  const Scratch scratch;
  const auto checked = [&](const std::string& text) {
    return kinetix_opt("check " + scratch.write("thin.yaml", "kinetix: 1\n" + text));
  };
  const std::string curve =
      "target: {kind: curve, points: [[0, 0], [15, 6], [30, 8], [45, 6], [60, 0]]}\nstructure: {cells: [12, "
      "1], cell_mm: 5}\n";
  const Outcome by_default = checked(curve);
  EXPECT_EQ(by_default.code, 0) << by_default.err;
  EXPECT_THAT(by_default.out, HasSubstr("a wall of 0.5 mm is below the minimum of polyjet, 0.6 mm"));
  EXPECT_EQ(checked(curve + "process: polyjet\n").code, 0);
  EXPECT_THAT(checked("target: {kind: surface, shape: cap}\nstructure: {wall_mm: {thickness: 0.3}}\n").out,
              HasSubstr("a wall of 0.3 mm is below the minimum of polyjet"));
}

TEST(AsMadeResult, TakesLimitsOfOnesOwnPrinter) {
  const Scratch scratch;
  const auto checked = [&](const std::string& process) {
    return kinetix_opt(
        "check " +
        scratch.write(
            "thin.yaml",
            "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [15, 6], [30, 8], [45, 6], [60, 0]]}\n"
            "structure: {cells: [12, 1], cell_mm: 5}\nprocess: " +
                process + "\n"));
  };
  EXPECT_EQ(checked("{base: polyjet, least_wall_mm: 0.5}").code, 0);
  EXPECT_THAT(checked("{base: polyjet, least_wall_mm: 0.7}").out,
              HasSubstr("a wall of 0.5 mm is below the minimum of polyjet, 0.7 mm"));
  EXPECT_THAT(checked("{least_pin_mm: -1}").err, HasSubstr("process.least_pin_mm"));
  EXPECT_THAT(checked("{clearance_mm: .nan}").err, HasSubstr("process.clearance_mm"));
}

TEST(AsMadeResult, SaysWhatPlayAdds) {
  const Scratch scratch;
  const auto of = [&](const std::string& hinge, const std::string& sd) {
    const Printed one =
        printed(scratch,
                "drive: {kind: shape_memory, k_turn: 5}\nhinge: {kind: pin, diameter_mm: 1.5" + hinge +
                    "}\nprocess: {sd: {" + sd + "}}\n",
                3);  // its knuckles collide during the motion
    EXPECT_EQ(schema_errors(one.result), "");
    return one;
  };
  const Printed tight = of(", clearance_mm: 0.05", "clearance_mm: 0"),
                loose = of(", clearance_mm: 0.05", "clearance_mm: 0.1");
  EXPECT_THAT(loose.out, HasSubstr("joint clearance 0.05 mm per side"));
  const Json one = tight.result["as_made"], other = loose.result["as_made"];
  EXPECT_LT(one["play"]["rms_without_mm"], one["rms_mm"]);
  EXPECT_LT(one["rms_mm"], other["rms_mm"]) << "clearances that scatter are larger ones";
  EXPECT_EQ(one["play"]["rms_without_mm"], other["play"]["rms_without_mm"]);
  EXPECT_FALSE(printed(scratch, "hinge: {kind: block}\n", 3).result["as_made"].contains("play"))
      << "of hinges that are no pins";
}

TEST(AsMadeResult, SaysWhyItDoesNotHold) {
  const Scratch scratch;
  const Json good = printed(scratch, "").result;
  EXPECT_EQ(good["as_made"]["can_be_printed"], true);
  EXPECT_EQ(good["as_made"]["holds"].get<bool>(), good["as_made"]["why"].empty());
  EXPECT_FALSE(good.contains("made_problems"));
  const Json rough = printed(scratch, "process: {sd: {tilt_deg: 5}}\n").result;
  EXPECT_EQ(schema_errors(rough), "");
  EXPECT_THAT(rough["as_made"]["why"].dump(), HasSubstr("prints may miss the limit: 95 % stay within"));
}

// Walls have 0.1 cell edges, here 0.5 mm. PolyJet, the default process, needs 0.6 mm.
TEST(AsMadeResult, SaysWhatCannotBePrinted) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(
      scratch.write(
          "thin.yaml",
          "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [15, 6], [30, 8], [45, 6], [60, 0]]}\n"
          "structure: {cells: [12, 1], cell_mm: 5}\n") +
      " -o " + folder + " --no-verify");
  ASSERT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["as_made"]["can_be_printed"], false);
  EXPECT_EQ(result["as_made"]["holds"], false);
  EXPECT_THAT(result["as_made"]["why"][0].get<std::string>(),
              HasSubstr("a wall of 0.5 mm is below the minimum of polyjet"));
  EXPECT_EQ(result["made_problems"][0]["kind"], "print");
  EXPECT_EQ(result["made_problems"][0]["what"], result["as_made"]["why"][0]);
}

struct SearchResult {
  Json result;
  std::string out, folder;
};

SearchResult found(const Scratch& scratch, const std::string& goal, const std::string& options = "") {
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("goal.yaml", "kinetix: 1\n" + goal) + " -o " + folder +
                                  " --no-verify --quiet" + options);
  EXPECT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  return {result, run.out, folder};
}

// These sheets are so large or so small that no print settles near its design.
TEST(AsMadeResult, OfNoPrintThatSettlesSaysSoAndNoNumbers) {
  const Scratch scratch;
  for (const char* goal :
       {"target: {kind: curve, points: [[0, 0], [200000, 150000], [450000, 220000], [700000, 150000], "
        "[900000, 0]], units: mm}\nstructure: {cells: [12, 1]}\n",
        "target: {kind: outline, points: [[0, 0], [0.005, 0], [0.005, 0.005], [0, 0.005]], units: mm}\n"
        "structure: {cells: [4, 4], trim: none}\n"}) {
    const SearchResult one = found(scratch, goal, " --hinge block");
    const Json& made = one.result["as_made"];
    EXPECT_EQ(made["prints"]["count"], 0);
    EXPECT_EQ(made["prints"]["failed"], 20);
    EXPECT_EQ(made["prints"]["kept"], 0);
    EXPECT_EQ(made["holds"], false) << "what finds no equilibrium does not hold";
    EXPECT_THAT(made["why"].dump(), HasSubstr("20 of 20 simulated prints have no equilibrium"));
    EXPECT_THAT(one.out, HasSubstr("none of 20 simulated prints has an equilibrium"));
    EXPECT_EQ(one.out.find("nan mm"), std::string::npos) << one.out;
  }
}

// The verdict matches `export` without options. If `export` refuses the design, the reason is the same.
TEST(AsMadeResult, CanBePrintedOnlyWhereExportWritesIt) {
  const Scratch scratch;
  for (const auto& [goal, fits] :
       {std::pair{"target: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n"
                  "structure: {cells: [12, 1]}\n",
                  true},
        {"target: {kind: outline, points: [[90, 0], [12, 18], [-60, 75], [-24, 0], [-75, -90], [12, -18]]}\n"
         "structure: {cells: [5, 5], trim: none}\ntolerance: {shape: 0.2, iou: 0.2}\n",
         false}}) {
    const SearchResult one = found(scratch, goal);
    const Json& made = one.result["as_made"];
    const Outcome print =
        kinetix_opt("export " + one.folder + " --format stl --quiet -o " + std::string(scratch / "print"));
    EXPECT_EQ(made["can_be_printed"], fits) << one.out;
    EXPECT_EQ(one.result["verdict"]["printable"], fits) << one.out;
    EXPECT_EQ(print.code, fits ? 0 : 3) << print.err;
    if (fits) continue;
    EXPECT_EQ(made["holds"], false);
    EXPECT_EQ(one.result["made_problems"][0]["kind"], "print");
    const std::string why = made["why"][0];  // advice is after it
    EXPECT_THAT(print.err, HasSubstr(why.substr(0, why.find("; with"))));
  }
}

// Plates press the panel of two by two cells beyond the range that is proven for misplaced walls. The strip stays
// within it.
TEST(AsMadeResult, SaysWhetherWallsOfPrintsMayMeet) {
  const Scratch scratch;
  for (const auto& [goal, is_free] :
       {std::pair{"target: {kind: fold, net: {faces: [{name: a, cells: [2, 2]}], creases: []}}\n", false},
        {"target: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n"
         "structure: {cells: [12, 1]}\n",
         true}}) {
    const SearchResult one = found(scratch, goal, " --hinge block");
    EXPECT_EQ(one.result["as_made"]["free_of_contact"], is_free) << one.out;
    EXPECT_EQ(one.result["certified"]["covers_theta_printed"], is_free);
    EXPECT_EQ(one.out.find("printed walls may collide: this design folds to ") == std::string::npos, is_free)
        << one.out;
    EXPECT_EQ(one.out.find(": OK, but walls may collide") == std::string::npos, is_free) << one.out;
    EXPECT_EQ(one.result["as_made"]["touching_share"], 0) << "as of prints found another way";
  }
}

// Errors accumulate along a ring, so its ends miss each other by much more than the error of one hinge.
TEST(AsMadeResult, ReportsTheShareOfPrintsThatTouch) {
  const Scratch scratch;
  const auto ring = [&](double gap_mm, const std::string& process) {
    std::string points;
    constexpr double radius_mm = 40, pi = 3.14159265358979;
    for (int k = 0; k <= 120; ++k) {
      const double angle = (2 * pi - gap_mm / radius_mm) * k / 120;
      points += fmt::format("{}[{:.6f}, {:.6f}]", k ? ", " : "", radius_mm * std::cos(angle),
                            radius_mm * std::sin(angle));
    }
    return found(scratch,
                 "target: {kind: curve, points: [" + points +
                     "]}\nstructure: {cells: [32, 1], cell_mm: 9, wall_mm: {thickness: 0.8, height: 5}}\n"
                     "process: " +
                     process + "\n");
  };
  double before = 1;
  for (const double gap_mm : {2.2, 7.0}) {
    const SearchResult one = ring(gap_mm, "sla");
    const Json& made = one.result["as_made"];
    const double share = made["touching_share"];
    EXPECT_LT(share, before) << "wider gaps, fewer that touch";
    EXPECT_GE(made["touching_prints"], 100);
    const bool is_free = share <= 0.05;
    EXPECT_EQ(made["free_of_contact"], is_free);
    EXPECT_EQ(one.out.find("OK, but walls touch in ") == std::string::npos, is_free) << one.out;
    EXPECT_EQ(one.result["verdict"]["problems"].dump().find("simulated prints") == std::string::npos,
              is_free);
    before = share;
  }
  EXPECT_LT(before, 0.02);
}

// An estimate to first order predicts a worse letter than the prints of such a panel show.
TEST(AsMadeResult, ADrivenDisplayIsExpectedToShowWhatItsPrintsShow) {
  const Scratch scratch;
  for (const std::string& rows : {"[\"00000\", \"01110\", \"00100\", \"00100\", \"00000\"]"s,
                                  "[\"000000\", \"011110\", \"010010\", \"011110\", \"000000\"]"s}) {
    const Json result = found(scratch, "target: {kind: display, rows: " + rows + "}\ndrive: {kind: hinge}\n",
                              " --monte-carlo 100")
                            .result;
    const Json& printed = result["display"]["printed"];
    const double expected = printed["expected"]["contrast"], seen = printed["prints"]["contrast"],
                 expected_95 = printed["expected"]["contrast_p05"],
                 seen_95 = printed["prints"]["contrast_p05"];
    EXPECT_EQ(printed["failed"], 0);
    EXPECT_NEAR(expected, seen, 0.1 * seen) << rows;
    EXPECT_NEAR(expected_95, seen_95, 0.15 * seen_95) << rows;
    if (seen_95 > 3.3) {
      EXPECT_EQ(printed["holds"], true) << printed.dump();
    }
  }
}

// The report has two distances of one design: between curves, and at points of the sheet.
TEST(AsMadeResult, NamesTheDesignsOwnDistanceBesideThatOfPrints) {
  const Scratch scratch;
  const Printed one = printed(scratch, "");
  const Json& made = one.result["as_made"];
  EXPECT_THAT(one.out, HasSubstr(app::format_figures(made["rms_mm"]) + " mm rms expected"));
  EXPECT_THAT(one.out, HasSubstr("error of the design itself at these points: " +
                                 app::format_figures(made["designed_mm"]) + " mm rms"));
}

TEST(AsMadeResult, JudgesPrintsOfDisplaysByTheirTolerances) {
  const Scratch scratch;
  const std::string letter =
      "kinetix: 1\ntarget: {kind: display, rows: [\"0000\", \"0110\", \"0110\", \"0000\"]}\n"
      "solver: {starts: 1, max_evaluations: 8}\ntolerance: {auc: 0.6, contrast: 0.5, stretch: 0.9}\n"
      "structure: {cell_mm: 10}\n";
  const auto shown = [&](const std::string& more) {
    const std::string folder = scratch / "out";
    const Outcome run =
        kinetix_opt(scratch.write("ring.yaml", letter + more) + " -o " + folder + " --no-verify");
    EXPECT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
    const Json result = Json::parse(text_of(folder + "/result.json"));
    EXPECT_EQ(schema_errors(result), "");
    return result["display"]["printed"];
  };
  const Json exact = shown("process: {sd: {t_mm: 0, tilt_deg: 0}}\n");
  EXPECT_EQ(exact["holds"], false) << "export would not write it";
  EXPECT_EQ(exact["why"].size(), 1u) << exact.dump();
  const Json rough = shown("process: {sd: {t_mm: 1.5, tilt_deg: 0}}\n");
  EXPECT_EQ(rough["holds"], false) << rough.dump();
  EXPECT_FALSE(rough["why"].empty());
}

const std::string octagon =
    "[[10, 0], [7.1, 7.1], [0, 10], [-7.1, 7.1], [-10, 0], [-7.1, -7.1], [0, -10], [7.1, -7.1], [10, 0]]";

// Covers every kind of goal that is judged by distances.
TEST(AsMadeResult, JudgesGoalsOfEveryKindBySoftBlocks) {
  const Scratch scratch;
  for (const std::string& goal :
       {"target: {kind: fold, box: [1, 1, 1], open: top}\ntolerance: {angle_deg: 1}\n"s,
        "target: {kind: fold, solid: tetrahedron}\n"s,
        "target: {kind: outline, points: " + octagon +
            "}\nstructure: {cells: [5, 5], trim: none, cell_mm: 10}\n",
        "target: {kind: space_curve, points: [[0, 0, 0], [50, 0, 10], [100, 15, 12], [150, 40, 10]]}\n"
        "structure: {cells: [20, 1]}\n"s}) {
    const SearchResult one = found(scratch, goal, " --hinge block --monte-carlo 100");
    const Json& made = one.result["as_made"];
    ASSERT_TRUE(made.contains("taken")) << one.out;
    EXPECT_EQ(made["taken"]["material"], "tango");
    EXPECT_LE(made["taken"]["strain"], made["taken"]["strain_allowed"]);
    EXPECT_THAT(one.out, HasSubstr("hinges: Tango block "));
    // The rms of 100 prints is within 7 % in 95 of 100 cases.
    EXPECT_EQ(made["prints"]["failed"], 0) << goal;
    EXPECT_NEAR(made["prints"]["rms_mm"], made["rms_mm"].get<double>(), 0.2 * made["rms_mm"].get<double>())
        << goal;
  }
}

TEST(AsMadeResult, RefusesProcessesThatNobodyHas) {
  const Scratch scratch;
  const auto refused = [&](const std::string& process) {
    const Outcome run = kinetix_opt("check " + scratch.write("arc.yaml", made_arc + process));
    EXPECT_EQ(run.code, 2) << process;
    return run.err;
  };
  EXPECT_THAT(refused("process: polijet\n"),
              HasSubstr("arc.yaml:5:10: process: `polijet` is not known (did you mean `polyjet`?)"));
  EXPECT_THAT(refused("process: {sd: {t_mm: -1}}\n"), HasSubstr("process.sd.t_mm"));
  EXPECT_THAT(refused("process: {sd: {tilt_deg: .nan}}\n"), HasSubstr("process.sd.tilt_deg"));
  EXPECT_THAT(refused("process: {nozzle: 1}\n"), HasSubstr("process.nozzle"));
}

}  // namespace
}  // namespace kinetix::testing
