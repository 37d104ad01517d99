#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stop_token>
#include <utility>

#include "app/goals/fold/fold_goal.hpp"
#include "app/goals/registry.hpp"
#include "app/pipeline/robust_search.hpp"
#include "model/base/geometry.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/app/searched_goal.hpp"

/// Tests of goals with elastic hinges.
namespace kinetix::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string arc = R"(kinetix: 1
name: arc
target: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}
structure: {cells: [12, 1]}
)";
const std::string rubber = "hinge: {kind: block, material: tango, gap_mm: 1}\n",
                  thin_rubber = "hinge: {kind: block, material: tango, gap_mm: 1, thickness_mm: 0.6}\n",
                  springs = "drive: {kind: shape_memory, k_turn: 5}\n";

/// A flap of 2 x 2 cells that folds by 90 degrees.
const std::string flap =
    "kinetix: 1\ntarget: {kind: fold, net: {faces: [{name: a, cells: [2, 2]}, {name: b, cells: [2, 2]}], "
    "creases: [{faces: [a, b], side: right, angle_deg: 90}]}}\n";

struct Finished {
  int code;
  std::string out, err;
  Json result;
};

Finished finished(const Scratch& scratch, const std::string& text, const std::string& more = "") {
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("goal.yaml", text) + " -o " + folder + more);
  Finished out{run.code, run.out, run.err, {}};
  if (run.code == 0 || run.code == 3) out.result = Json::parse(text_of(folder + "/result.json"));
  return out;
}

TEST(Matter, MakesUpForSoftHingesOfACurve) {
  const Scratch scratch;
  const Finished run = finished(scratch, arc + thin_rubber + springs);
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_EQ(schema_errors(run.result), "");
  const Json& compensation = run.result["matter"];
  EXPECT_GT(compensation["before_mm"], 10 * compensation["after_mm"].get<double>());
  EXPECT_LE(compensation["after_mm"], compensation["tolerance_mm"]);
  EXPECT_LE(run.result["metrics"]["verify_rms"], 1e-4);
  EXPECT_EQ(run.result["states"][0]["model"], "equilibrium");
  const std::string plan = run.result["plan"]["why"].dump();
  EXPECT_THAT(plan, HasSubstr("states are equilibria"));
  EXPECT_THAT(plan, ::testing::Not(HasSubstr("states follow from the analytic motion")));
  EXPECT_THAT(plan, HasSubstr("fold angle limited to"));
  EXPECT_NEAR(run.result["as_made"]["designed_mm"], compensation["after_mm"], 1e-6);
  EXPECT_THAT(run.out, HasSubstr("with elastic hinges, "));
  const Json& is_free = run.result["as_made"]["free_of_contact"];
  EXPECT_EQ(is_free.is_null(), run.result["certified"].value("covers_theta_printed", true)) << is_free;
  EXPECT_NE(is_free, true) << "nothing is proven of an equilibrium";
  EXPECT_EQ(run.out.find(" mm: OK\n"), std::string::npos) << run.out;

  // The result's curve is that of the displayed state. A column has two bodies.
  const Json &folded = run.result["curve"]["folded_mm"], &poses = run.result["states"][0]["poses"];
  ASSERT_EQ(2 * folded.size(), poses.size());
  for (std::size_t c = 0; c < folded.size(); ++c)
    for (const auto& [axis, k] : {std::pair{0, 0}, {2, 1}}) {
      const double one = poses[2 * c]["position_mm"][axis], other = poses[2 * c + 1]["position_mm"][axis];
      EXPECT_NEAR(folded[c][k], (one + other) / 2, 1e-5) << "column " << c;
    }

  // `verify` of the design alone gives the same result.
  const std::string folder = scratch / "out";
  const Outcome again = kinetix_opt("verify " + folder + "/design.yaml -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_THAT(text_of(folder + "/design.yaml"),
              AllOf(HasSubstr("material: tango"), HasSubstr("shape_memory")));
}

TEST(Matter, KeepsTiltsAlikeThatTheFileTies) {
  const auto sizes = [](const std::string& beta) {
    const Scratch scratch;
    const Finished run = finished(
        scratch, arc + thin_rubber + springs + "variables: {beta: {" + beta + "}}\n", " --no-verify");
    EXPECT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
    EXPECT_GT(run.result["matter"]["largest_change_rad"], 0);
    std::set<long> all;  // sizes in millionths of a radian
    for (const Json& hinge : run.result["structure"]["hinges"])
      all.insert(std::lround(1e6 * std::abs(hinge["beta_rad"].get<double>())));
    all.erase(0);
    return all.size();
  };
  EXPECT_LE(sizes("symmetry: mirror_x"), 6u) << "of 12 columns";
  EXPECT_EQ(sizes("per: all"), 1u);
}

/// The strip keeps its shape with thick blocks, too, but at a strain of 0.65. They withstand 0.5.
TEST(Matter, ACurveWhoseHingesTearIsNotMet) {
  const Scratch scratch;
  const Finished run = finished(scratch, arc + rubber + springs, " --no-verify");
  ASSERT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_EQ(run.result["metrics"]["met"], false);
  EXPECT_GT(run.result["metrics"]["strain_max"], run.result["metrics"]["strain_allowed"]);
  EXPECT_LE(run.result["matter"]["after_mm"], run.result["matter"]["tolerance_mm"]);
  ASSERT_EQ(run.result["curve"]["reasons"].size(), 1u);
  EXPECT_THAT(run.result["curve"]["reasons"][0].get<std::string>(),
              AllOf(HasSubstr("the hinge of wall "), HasSubstr("the limit of its material is 0.5")));
}

/// The walls of this cuff touch during the motion, which the search for its tilts ignores. The path from flat ends next
/// to the result of that search, within the goal's tolerance.
TEST(Matter, JudgesACurveWhereItsPathFromFlatEnds) {
  const Scratch scratch;
  const Finished run = finished(scratch, R"(kinetix: 1
target: {kind: curve, points: [[27, -20], [33, -8], [34, 5], [28, 18], [15, 26], [0, 28], [-15, 26], [-28, 18], [-34, 5],
  [-33, -8], [-27, -20]]}
structure: {cells: [24, 2], wall_mm: {thickness: 1, height: 7}}
process: fdm
hinge: {kind: film, material: tpu95a, gap_mm: 1.5, thickness_mm: 0.4}
drive: {kind: shape_memory, k_turn: 20}
)",
                                " --no-verify");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  const Json& compensation = run.result["matter"];
  EXPECT_THAT(
      compensation["why"].get<std::string>(),
      ::testing::ContainsRegex("in another equilibrium than the one near the goal, [0-9.e-]+ mm from it, "
                               "and within tolerance as well"));
  EXPECT_NEAR(run.result["as_made"]["designed_mm"], compensation["after_mm"], 1e-6);
  EXPECT_LE(compensation["after_mm"], compensation["tolerance_mm"]);
}

TEST(Matter, SaysWhereASheetLeansInsteadOfFolding) {
  const Scratch scratch;
  const Finished run = finished(scratch, R"(kinetix: 1
target: {kind: curve, points: [[0, 0], [60, 24], [120, 32], [180, 24], [240, 0]]}
structure: {cells: [32, 1]}
)" + rubber,
                                " --no-verify");
  ASSERT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out,
              ::testing::ContainsRegex("try `drive: .kind: shape_memory, k_turn: [0-9.]+.`, springs in "
                                       "all hinges, 4 times as stiff as these"));
}

/// Runs a sheet with a small crease error, which does not lean. No spring is proposed, and the distance between the end
/// of the path and the searched state is reported.
void expect_no_springs(const std::string& fold, const std::string& tolerance_deg) {
  const Scratch scratch;
  const Finished run = finished(scratch,
                                fold + "tolerance: {angle_deg: " + tolerance_deg +
                                    "}\nstructure: {cell_mm: 30, wall_mm: {thickness: 2, height: 12}}\n"
                                    "hinge: {kind: pin, diameter_mm: 3, clearance_mm: 0.3}\n",
                                " --no-verify");
  ASSERT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_LT(run.result["matter"]["after_mm"], 0.2 * run.result["matter"]["tolerance_mm"].get<double>());
  EXPECT_THAT(run.out, HasSubstr("deg is required, within " + tolerance_deg + " deg"));
  EXPECT_EQ(run.out.find("lean or buckle"), std::string::npos) << run.out;
  if (run.out.find("in another equilibrium") != std::string::npos) {
    EXPECT_THAT(run.out, ::testing::ContainsRegex("than the one near the goal, [0-9.e-]+ mm from it"));
  }
}

TEST(Matter, ProposesNoSpringsWhereASheetFoldsWell) { expect_no_springs(flap, "0.001"); }

/// The path of this box ends in another equilibrium.
TEST(MatterSoak, ProposesNoSpringsWhereABoxFoldsWell) {
  expect_no_springs("kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\n", "0.05");
}

TEST(Matter, MakesUpForSoftHingesOfABox) {
  const Scratch scratch;
  const Finished run = finished(
      scratch,
      "kinetix: 1\ntarget: {kind: fold, box: [1, 1, 1], open: top}\ntolerance: {angle_deg: 1}\nhinge: "
      "{kind: block, material: {E_mpa: 1, nu: 0.48, strain_max: 0.7}, gap_mm: 1, thickness_mm: 0.6}\n" +
          springs);
  ASSERT_EQ(run.result["verdict"]["met"], true) << run.out << run.err;
  EXPECT_EQ(schema_errors(run.result), "");
  const Json& compensation = run.result["matter"];
  EXPECT_GT(compensation["before_mm"], 10 * compensation["after_mm"].get<double>());
  EXPECT_LE(run.result["metrics"]["verify_rms"], 1e-4);
  EXPECT_LE(run.result["metrics"]["fold_miss_physics_deg"], 1);
  EXPECT_NEAR(run.result["metrics"]["fold_miss_deg"],
              run.result["metrics"]["fold_miss_physics_deg"].get<double>(), 1e-3)
      << "of the equilibrium, not of the exact state";
}

const std::string soft_blocks =
    "structure: {cell_mm: 20}\nhinge: {kind: block, material: tango, gap_mm: 2, thickness_mm: 0.8}\n";
const std::string small_box = "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\n" + soft_blocks,
                  small_flap = flap + soft_blocks;

const std::string soft_disc = R"(kinetix: 1
target: {kind: outline, points: [[20, 0], [14.1, 14.1], [0, 20], [-14.1, 14.1], [-20, 0], [-14.1, -14.1], [0, -20], [14.1, -14.1]]}
structure: {cells: [6, 6], trim: none, cell_mm: 10, wall_mm: {thickness: 1.6, height: 8}}
variables: {offset_mm: 0.4, theta: {range_deg: [20, 25]}}
tolerance: {shape: 0.05, iou: 0.8}
)";

TEST(Matter, AFoldKeepsItsLimits) {
  const Scratch scratch;
  const Finished run =
      finished(scratch, small_flap + springs + "tolerance: {angle_deg: 1, strain: 0.3}\n", " --no-verify");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_EQ(schema_errors(run.result), "");
  EXPECT_LE(run.result["metrics"]["strain_max"], 0.3);
  EXPECT_LE(run.result["fold"]["loads"]["strain"], 0.3);
  EXPECT_GT(run.result["fold"]["unlimited"]["strain"], 0.3);
  EXPECT_THAT(run.out, HasSubstr("without limits at a fold angle of"));
}

TEST(Matter, AFoldThatIsStoppedWhileItLooksForItsLimitsTellsNothingThatItDidNotSee) {
  const Scratch scratch;
  const app::Target target = app::read_target(
      scratch.write("goal.yaml", small_box + springs + "tolerance: {angle_deg: 1, strain: 0.3}\n"));
  for (const bool at_once : {false, true}) {
    SCOPED_TRACE(at_once);
    std::stop_source stop;
    app::RunOptions options;
    options.stop = stop.get_token();
    options.progress = [&](const std::string& stage, double, const std::string&) {
      if (stage == "limits") stop.request_stop();
    };
    if (at_once) stop.request_stop();
    const app::SearchResult found = target.goal->search(options);
    const auto& fold = app::outcome_of<app::FoldOutcome>(found);
    EXPECT_FALSE(fold.unlimited) << "no other theta was found";
    ASSERT_EQ(fold.loads.has_value(), !at_once);
    if (fold.loads) {
      EXPECT_GT(fold.loads->hinges.strain, 0.3);
    }
  }
}

TEST(Matter, TheRemovedSolverIsRefusedBeforeTheSearch) {
  const Scratch scratch;
  const Finished run = finished(scratch, small_box + "physics: {solver: sweeps}\n");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("physics.solver: `sweeps` was removed"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST(Matter, LimitsOfAFoldMustFitItsDrive) {
  const Scratch scratch;
  EXPECT_THAT(finished(scratch, small_box + springs + "tolerance: {force_N: 3}\n").err,
              HasSubstr("goal.yaml:6:13: tolerance.force_N: only applies to an external drive"));
  EXPECT_THAT(
      finished(scratch, "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\ntolerance: {force_N: 3}\n").err,
      HasSubstr("tolerance.force_N: only applies to elastic hinges. Add `hinge`"));
  const std::string rotary =
      "hinge: {model: rotary, kind: block, material: tango, gap_mm: 2, thickness_mm: 0.8}\n";
  EXPECT_THAT(
      finished(scratch, "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\nstructure: {cell_mm: 20}\n" +
                            rotary + "tolerance: {strain: 0.3}\n")
          .err,
      HasSubstr("goal.yaml:5:13: tolerance.strain: only applies to elastic hinges. Remove `model: rotary`"));
}

TEST(Matter, AnOutlineIsJudgedInItsHinges) {
  const Scratch scratch;
  const Finished run = finished(
      scratch,
      soft_disc + "hinge: {kind: block, material: tango, gap_mm: 1.2, thickness_mm: 0.8}\n" + springs);
  ASSERT_EQ(run.result["verdict"]["met"], true) << run.out << run.err;
  EXPECT_EQ(schema_errors(run.result), "");
  const Json& metrics = run.result["metrics"];
  EXPECT_NEAR(metrics["outline_rms"], run.result["outline"]["exact"]["rms"].get<double>(), 0.01);
  EXPECT_EQ(metrics["outline_rms"], run.result["outline"]["equilibrium"]["rms"]);
  EXPECT_NEAR(metrics["outline_rms_physics"], metrics["outline_rms"].get<double>(), 1e-4);
  EXPECT_GT(run.result["matter"]["before_mm"], run.result["matter"]["after_mm"]);
}

TEST(Matter, AnOutlineWithHingesNeedsItsCells) {
  const Scratch scratch;
  EXPECT_THAT(
      finished(scratch,
               "kinetix: 1\ntarget: {kind: outline, points: [[0, 0], [9, 0], [9, 9], [0, 9]]}\n" + rubber)
          .err,
      HasSubstr("goal.yaml:3:1: hinge: the size of a hinge needs a known cell size"));
}

const std::string film_creases =
    "hinge: {kind: pin, diameter_mm: 1.5, clearance_mm: 0.05, except: [{at: creases, kind: film, material: "
    "pp, gap_mm: 2, "
    "thickness_mm: 0.3}]}\n";

TEST(Matter, ACurveOfPinsHasItsCreasesOfFilm) {
  const Scratch scratch;
  const Finished run = finished(scratch, arc + film_creases + "drive: {kind: shape_memory, k_turn: 200}\n");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_EQ(schema_errors(run.result), "");
  EXPECT_LE(run.result["metrics"]["verify_rms"], 1e-3) << "physics has the same hinges";
  int films = 0, pins = 0;
  for (const Json& hinge : run.result["structure"]["hinges"]) {
    const bool leans = std::abs(hinge["beta_rad"].get<double>()) > 1e-9;
    EXPECT_EQ(hinge["k"]["turn"].get<double>() > 1, leans)
        << "N mm/rad: a pin turns with 0.1, " << hinge.dump();
    (leans ? films : pins)++;
  }
  EXPECT_EQ(films, 24);
  EXPECT_EQ(pins, 13);
  EXPECT_GT(run.result["metrics"]["strain_max"], 0);
  EXPECT_EQ(run.result["metrics"]["strain_allowed"], 0.1) << "of film, which pins have none of";
  EXPECT_EQ(run.result["as_made"]["play"]["clearance_mm"], 0.05) << "of pins, which films have none of";
  EXPECT_LT(run.result["as_made"]["play"]["rms_without_mm"], run.result["as_made"]["rms_mm"]);

  // `verify` of the design alone reaches the same state, and the design can be made.
  const std::string design = (scratch / "out" / "design.yaml").string();
  const Outcome again = kinetix_opt("verify " + design + " -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  const Json same = Json::parse(text_of(scratch.path() + "/again/result.json"));
  EXPECT_NEAR(same["states"][0]["theta_rad"], run.result["states"][0]["theta_rad"].get<double>(), 1e-6);
}

TEST(Matter, ATargetsPartsAreItsCreases) {
  const Scratch scratch;
  const std::string film = "kind: film, material: pp, gap_mm: 2, thickness_mm: 0.3}]}\n";
  EXPECT_THAT(finished(scratch, arc + "hinge: {except: [{at: {column: 2}, " + film).err,
              HasSubstr("goal.yaml:5:23: hinge.except[0].at: only a design has a known column"));
  EXPECT_THAT(finished(scratch, soft_disc + "hinge: {except: [{at: creases, " + film).err,
              HasSubstr("goal.yaml:6:9: hinge.except: the hinges of a panel are upright"));
}

TEST(Matter, TiltsStayWithinTheFilesRange) {
  const Scratch scratch;
  const Finished run = finished(
      scratch, arc + rubber + springs + "variables: {beta: {range_deg: [-14, 14]}}\n", " --no-verify");
  ASSERT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
  double largest = 0;
  for (const Json& hinge : run.result["structure"]["hinges"])
    largest = std::max(largest, std::abs(hinge["beta_rad"].get<double>()));
  EXPECT_LE(largest, 14.001 * radians_per_degree);
}

TEST(Matter, ARobustCurveHasBetterPrints) {
  const Scratch scratch;
  const std::string curve =
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n"
      "structure: {cells: [20, 1]}\n";
  const Finished plain = finished(scratch, curve + rubber + springs, " --no-verify"),
                 robust = finished(scratch, curve + rubber + springs + "robust: true\n", " --no-verify");
  ASSERT_EQ(plain.code, 0) << plain.out << plain.err;
  ASSERT_EQ(robust.code, 0) << robust.out << robust.err;
  EXPECT_EQ(schema_errors(robust.result), "");
  EXPECT_LE(robust.result["metrics"]["as_made_rms_mm"],
            0.6 * plain.result["metrics"]["as_made_rms_mm"].get<double>());
  EXPECT_LE(robust.result["metrics"]["shape_rms"], 0.01);
  int chosen = 0, other_gaps = 0, compensated = 0;
  for (const Json& one : robust.result["curve"]["robust"]) {
    other_gaps += one["gap_mm"] != 1.0;
    compensated += one["in_matter"].get<bool>();
    if (!one["chosen"]) continue;
    ++chosen;
    const double said = one["as_made_rms_mm"], comes = robust.result["as_made"]["first_order_rms_mm"];
    EXPECT_NEAR(said, comes, 0.01 * comes) << "it is judged as the run leaves it";
  }
  EXPECT_EQ(chosen, 1);
  EXPECT_EQ(compensated, 6);
  EXPECT_GE(other_gaps, 2) << "gaps are tried as well";
  EXPECT_THAT(robust.out, ::testing::ContainsRegex("strips tried|tried [0-9]+ strips"));
}

TEST(Matter, ARobustCurveCanBePrintedWhereThePlainOneCan) {
  const Scratch scratch;
  const std::string curve =
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [25, 0], [45, 15], [50, 40]]}\n"
      "structure: {wall_mm: {thickness: 1, height: 6}, cell_mm: 7}\n"
      "hinge: {kind: block, material: tango, gap_mm: 2.2}\ndrive: {kind: shape_memory, k_turn: 20}\n";
  const Finished plain = finished(scratch, curve, " --no-verify"),
                 robust = finished(scratch, curve + "robust: true\n", " --no-verify");
  EXPECT_EQ(plain.result["verdict"]["printable"], true);
  EXPECT_EQ(robust.result["verdict"]["printable"], true);
  EXPECT_LE(robust.result["metrics"]["as_made_rms_mm"],
            1.001 * plain.result["metrics"]["as_made_rms_mm"].get<double>());
}

TEST(Matter, WhatPrintsOfThePlainStripComeToMayBeUnknown) {
  const Scratch scratch;
  const Finished run =
      finished(scratch,
               "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [20, 0], [36, 12], [40, 32]]}\n"
               "structure: {wall_mm: {thickness: 1.6, height: 6}, cell_mm: 7}\n"
               "hinge: {kind: block, material: tango, gap_mm: 2.2}\ndrive: {kind: shape_memory, k_turn: 20}\n"
               "robust: true\nsolver: {starts: 2}\n",
               " --no-verify");
  ASSERT_TRUE(run.result["curve"]["robust"][0]["as_made_rms_mm"].is_null()) << run.out;
  EXPECT_THAT(run.out, HasSubstr("deg, unknown"));
  EXPECT_THAT(run.out, Not(HasSubstr("nan mm")));
}

TEST(Matter, AWeightTradesTheDesignAgainstItsPrints) {
  const Scratch scratch;
  const std::string curve =
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n"
      "structure: {cells: [12, 1], cell_mm: 10.6}\n";
  const Finished run = finished(scratch, curve + "robust: 0.3\n", " --no-verify");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  const auto cost = [&](const Json& one) {
    return 0.7 * one["shape_rms"].get<double>() * run.result["curve"]["scale_mm"].get<double>() +
           0.3 * one["as_made_rms_mm"].get<double>();
  };
  double least = 1e9, chosen = 0;
  for (const Json& one : run.result["curve"]["robust"]) {
    if (one["allowed"]) least = std::min(least, cost(one));
    if (one["chosen"]) chosen = cost(one);
  }
  EXPECT_NEAR(chosen, least, 1e-9);
  for (const char* bad : {"0", "1.5", "-1", ".nan", "maybe", "[1]"}) {
    const Finished refused = finished(scratch, curve + "robust: " + bad + "\n");
    EXPECT_EQ(refused.code, 2) << bad;
    EXPECT_THAT(refused.err, HasSubstr("goal.yaml:4:9: robust: ")) << bad;
  }
}

TEST(Matter, ARobustFoldIsOneWhosePrintsComeNearer) {
  const Scratch scratch;
  const std::string fold = flap + rubber + springs;
  const Finished plain = finished(scratch, fold, " --no-verify"),
                 robust = finished(scratch, fold + "robust: true\n", " --no-verify");
  ASSERT_TRUE(plain.code == 0 || plain.code == 3) << plain.out << plain.err;
  ASSERT_TRUE(robust.code == 0 || robust.code == 3) << robust.out << robust.err;
  EXPECT_EQ(schema_errors(robust.result), "");
  const Json& tried = robust.result["robust"];
  EXPECT_GE(tried.size(), 10u) << "other values of theta and other gaps";
  const auto chosen =
      std::find_if(tried.begin(), tried.end(), [](const Json& one) { return one["chosen"].get<bool>(); });
  ASSERT_NE(chosen, tried.end());
  for (const Json& one : tried)
    if (one["allowed"]) {
      EXPECT_LE((*chosen)["as_made_rms_mm"], one["as_made_rms_mm"]);
    }
  EXPECT_LE(robust.result["metrics"]["as_made_rms_mm"], plain.result["metrics"]["as_made_rms_mm"]);
  EXPECT_THAT(robust.out, HasSubstr("tried "));
}

/// All creases of a tetrahedron have the same number of hinges.
TEST(Matter, TellsTheTiltsOfASolidThatMakesUpForItsHinges) {
  const Scratch scratch;
  const app::Target target = app::read_target(scratch.write(
      "goal.yaml", "kinetix: 1\ntarget: {kind: fold, solid: tetrahedron}\n" + rubber + springs));
  const Json result = unwritten_result(settled(searched_goal(*target.goal), *target.goal, {}));
  ASSERT_TRUE(result.contains("matter"));
  double leaning = 0, reported = 0;  // rad, deg: sums, then means
  int hinges = 0;
  for (const Json& hinge : result["structure"]["hinges"]) {
    const double tilt = std::abs(hinge["beta_rad"].get<double>());
    if (!(tilt > 1e-6)) continue;
    leaning += tilt;
    ++hinges;
  }
  const Json& creases = result["fold"]["creases"];
  for (const Json& crease : creases) reported += crease["tilt_deg"].get<double>();
  ASSERT_GT(hinges, 0);
  EXPECT_NEAR(reported / static_cast<double>(creases.size()), to_degrees(leaning / hinges), 1e-6);
}

TEST(Matter, ARobustSearchAllowsWhatMeetsItsGoalInTheEquilibriumToo) {
  const Scratch scratch;
  const auto allowed = [&](const std::string& tolerance) {
    const app::Target target = app::read_target(scratch.write("goal.yaml", small_box + springs + tolerance));
    const app::SearchResult exact = target.goal->search({});
    EXPECT_TRUE(held(exact, target.goal.get(), {}).met()) << "exactly";
    const app::RobustCandidate found = robust_candidate(exact, *target.goal, {});
    EXPECT_EQ(found.is_allowed, found.why_not.empty());
    if (!found.is_allowed) {
      EXPECT_EQ(found.why_not, "its elastic hinges miss the goal");
    }
    return found.is_allowed;
  };
  EXPECT_TRUE(allowed("tolerance: {angle_deg: 1}\n"));
  EXPECT_FALSE(allowed("tolerance: {angle_deg: 0.001}\n")) << "soft hinges miss that by 0.3 deg";
}

TEST(Matter, ARobustCurveInSpaceIsOneWhosePrintsComeNearer) {
  const Scratch scratch;
  std::string points;
  for (int k = 0; k <= 20; ++k)
    points += fmt::format("{}[{:.3f}, {:.3f}, {:.3f}]", k ? ", " : "", 120 * std::sin(0.1 * k), 4.0 * k,
                          120 - 120 * std::cos(0.1 * k));
  const std::string goal = "kinetix: 1\ntarget: {kind: space_curve, points: [" + points +
                           "]}\nstructure: {cells: [24, 1]}\n"
                           "tolerance: {shape: 0.05}\n";
  const Finished plain = finished(scratch, goal, " --no-verify"),
                 robust = finished(scratch, goal + "robust: true\n", " --no-verify");
  ASSERT_EQ(plain.code, 0) << plain.out << plain.err;
  ASSERT_EQ(robust.code, 0) << robust.out << robust.err;
  EXPECT_EQ(schema_errors(plain.result), "");
  EXPECT_EQ(schema_errors(robust.result), "");
  double least = 1e9;  // mm: smallest expected rms of the allowed designs
  for (const Json& one : robust.result["robust"])
    if (one["allowed"]) least = std::min(least, one["as_made_rms_mm"].get<double>());
  EXPECT_GE(robust.result["robust"].size(), 5u);
  EXPECT_NEAR(robust.result["as_made"]["first_order_rms_mm"], least, 1e-9) << "what was expected of it";
  EXPECT_LE(robust.result["metrics"]["as_made_rms_mm"], plain.result["metrics"]["as_made_rms_mm"]);
}

TEST(Matter, KindsWithoutARobustSearchSayWhichHaveOne) {
  const Scratch scratch;
  const Finished run = finished(scratch, "kinetix: 1\ntarget: {kind: display, glyph: T}\nrobust: true\n");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("3:9: robust"), HasSubstr("use one of: curve, fold")));
  const Finished solid =
      finished(scratch, "kinetix: 1\ntarget: {kind: fold, solid: octahedron}\nrobust: true\n");
  EXPECT_EQ(solid.code, 2);
  EXPECT_THAT(solid.err, HasSubstr("Remove the key for a solid"));
}

const std::string letter = R"(kinetix: 1
target: {kind: display, glyph: T}
structure: {cells: [8, 8], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}
hinge: {kind: block, material: tango, gap_mm: 2, thickness_mm: 1.2}
)";

TEST(Matter, ADisplayKeepsItsLimits) {
  const Scratch scratch;
  const Finished run = finished(
      scratch, letter + "drive: {compression: 0.185}\ntolerance: {strain: 0.25, force_N: 20, contrast: 1}\n");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_EQ(schema_errors(run.result), "");
  const Json& display = run.result["display"];
  EXPECT_LE(display["loads"]["strain"], 0.25);
  EXPECT_GE(display["loads"]["strain"], 0.2) << "no less than it need be";
  EXPECT_LE(run.result["metrics"]["strain_max"], 0.25);
  EXPECT_LE(run.result["metrics"]["force_N"], 20);
  EXPECT_GT(display["unlimited"]["strain"], 0.25);
  EXPECT_LT(display["compression"], 0.185);
  EXPECT_THAT(run.out, HasSubstr("without limits compressed by 18.5 %"));
}

TEST(Matter, PrintsOfADisplayAreAsExpected) {
  const Scratch scratch;
  const Finished run = finished(scratch, letter + "tolerance: {strain: 0.25, contrast: 1}\n",
                                " --no-verify --monte-carlo 300");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  const Json &expected = run.result["display"]["printed"]["expected"],
             &prints = run.result["display"]["printed"]["prints"];
  EXPECT_EQ(run.result["display"]["printed"]["failed"], 0);
  EXPECT_NEAR(expected["contrast"], prints["contrast"], 0.1 * prints["contrast"].get<double>());
  EXPECT_NEAR(expected["contrast_p05"], prints["contrast_p05"], 0.1 * prints["contrast"].get<double>());
  EXPECT_EQ(expected["contrast_p95"], expected["contrast_p05"]) << "the older name";
  EXPECT_LE(expected["contrast_p05"], expected["contrast"]) << "a 5th percentile is below the mean";
  EXPECT_NEAR(expected["auc"], prints["auc"], 0.01);
}

/// Equilibria of such soft hinges agree within 2e-4 cell edges because of residual forces. They count as one.
TEST(Matter, TellsNoOtherEquilibriumWhereThePathEndsInTheOneThatWasFound) {
  const Scratch scratch;
  const Finished run = finished(
      scratch,
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [30, 25], [70, 38], [110, 30], [150, 8], [190, 0], "
      "[230, 14], [260, 40]]}\nstructure: {cell_mm: 8.4}\n"
      "hinge: {kind: block, material: tango, gap_mm: 3}\n",
      " --no-verify");
  ASSERT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("plates and single hinges let soft hinges lean or buckle"));
  EXPECT_THAT(run.out, ::testing::Not(HasSubstr("another equilibrium")));
}

TEST(Matter, RefusesWhatCannotBeMade) {
  const struct {
    std::string text;
    const char* message;
  } cases[] = {
      {letter + "variables: {offset_mm: 0.5}\n",
       "variables.offset_mm: this kind of hinge fits in walls of 2 mm at most 0.4 mm off their middle"},
      {letter + "tolerance: {strain: 0.8}\n",
       "tolerance.strain: 0.8 is more than the material of `hinge` withstands. Give at most 0.5"},
      {letter + "drive: {kind: hinge}\ntolerance: {force_N: 3}\n",
       "tolerance.force_N: applies to plates only"},
      {"kinetix: 1\ntarget: {kind: display, glyph: T}\ntolerance: {strain: 0.3}\n",
       "tolerance.strain: only applies to blocks and living hinges"},
      {arc + rubber + "drive: {kind: usual, k_turn: 5}\n", "drive.k_turn"},
      {arc + rubber + "drive: {kind: shape_memory}\n", "`k_turn` is missing"},
      {arc + "drive: {kind: shape_memory, k_turn: 5}\n", "drive: shape_memory needs elastic hinges"},
      {arc + rubber + "drive: {kind: heat}\n", "auto, shape_memory"},
  };
  for (const auto& [text, message] : cases) {
    const Scratch scratch;
    const Finished run = finished(scratch, text);
    EXPECT_EQ(run.code, 2) << message;
    EXPECT_THAT(run.err, HasSubstr(message));
  }
}

}  // namespace
}  // namespace kinetix::testing
