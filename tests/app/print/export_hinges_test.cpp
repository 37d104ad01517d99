#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/print/fit.hpp"
#include "app/print/format/zip_text.hpp"
#include "app/print/slicer.hpp"
#include "model/base/invalid_input.hpp"
#include "model/linkage/state.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/program.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

TEST(Export, RefusesWhatItCannotMake) {
  expect_refused(panel, "--format stepp", "unknown format `stepp` (did you mean `step`?)");
  expect_refused(panel, "--format stl --process fdmm", "unknown process `fdmm` (did you mean `fdm`?)");
  expect_refused(panel, "--format stl --hinge peg", "unknown hinge `peg`");
  const std::string thin = std::string(panel).replace(std::string(panel).find("0.8"), 3, "0.5");
  expect_refused(thin, "--format stl --process fdm", "a wall of 0.5 mm is below the minimum of fdm, 0.8 mm",
                 not_printable);
  expect_refused(std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.06}\n",
                 "--format stl --process sla", "a clearance of 0.06 mm is below the minimum of sla, 0.25 mm",
                 not_printable);
  expect_refused(std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.4}\n",
                 "--format stl --process fdm", "a rod of 1 mm is below the minimum of fdm, 3 mm",
                 not_printable);
}

/// Films of the walls' material are thin walls: one extruder, no glue.
TEST(Export, MakesFilmsOfTheWallsMaterialWhereTheProcessPrintsThem) {
  for (const auto& [process, material, volumes] :
       {std::tuple{"fdm", "pp", 1}, {"sls", "pa12", 1}, {"polyjet", "pp", 2}, {"sla", "pp", 2}}) {
    const Scratch scratch;
    const std::string choice = std::string("--hinge film --process ") + process;
    ASSERT_EQ(exported(scratch, panel, "--format 3mf " + choice).code, 0);
    const std::string config = app::text_in_zip(scratch / "out/panel.3mf", "Metadata/Slic3r_PE_model.config");
    EXPECT_EQ(config.find("key=\"extruder\" value=\"2\"") == std::string::npos, volumes == 1) << process;
    const std::string text = text_of(scratch / "out/print.txt");
    EXPECT_THAT(text, HasSubstr(std::string("living hinges of ") + material + ":"));
    EXPECT_EQ(text.find("glue them") != std::string::npos, std::string(process) == "sla") << text;
  }
}

/// The design without hinges exists only in memory, since a file has at least one wall.
TEST(Export, RefusesADesignWithoutHinges) {
  const Scratch scratch;
  app::Design design = app::read_design(scratch.write("panel.yaml", panel));
  design.structure.squares()->hinges.clear();
  const app::PrintPath flat{{0}, {rest_state(model::Linkage(design.structure))}};
  try {
    make_print_sheet(design, flat, model::processes().front(), {});
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("the design has no hinges"));
  }
}

TEST(Export, RefusesAHingeOnAJunctionAndSaysWhichCellWouldDo) {
  std::string design = panel;
  design.replace(design.find("{theta_deg: 20}"), 15,
                 "{theta_deg: 20, hinges: [{wall: [[0, 0], [1, 0]], t: 0.1}, {wall: [[0, 1], [1, 1]], t: "
                 "0.9}, {wall: [[0, 2], [1, 2]], t: 0.1}]}");
  expect_refused(design, "--format stl --hinge pin", "overlaps the junction at vertex [0, 0]", not_printable);
  const Scratch scratch;
  const Outcome refused = exported(scratch, design, "--format stl --hinge pin");
  std::smatch edge;
  ASSERT_TRUE(std::regex_search(refused.err, edge, std::regex(R"(give --cell-mm ([0-9.]+))"))) << refused.err;
  EXPECT_EQ(exported(scratch, design, "--format stl --hinge pin --cell-mm " + edge.str(1)).code, 0);
  const double less = std::stod(edge.str(1)) - 0.5;
  EXPECT_EQ(exported(scratch, design, "--format stl --hinge pin --cell-mm " + std::to_string(less)).code,
            not_printable);
}

// Walls are too thin for both kinds. The cells that are suggested have room for pins, which fold.
TEST(Export, SuggestsCellsForPinsBeforeThoseForBlocks) {
  const std::string design =
      "kinetix: 1\nstructure: {cells: [3, 2], cell_mm: 8, wall_mm: {thickness: 0.6, height: 6}}\n"
      "design: {theta_deg: 20}\n";
  const Scratch scratch;
  const Outcome refused = exported(scratch, design, "--format stl --process fdm");
  EXPECT_EQ(refused.code, not_printable);
  std::smatch edge;
  ASSERT_TRUE(std::regex_search(refused.err, edge, std::regex(R"(give --cell-mm ([0-9.]+))"))) << refused.err;
  ASSERT_EQ(exported(scratch, design, "--format stl --process fdm --cell-mm " + edge.str(1)).code, 0);
  EXPECT_EQ(print_json_of(scratch)["hinge"], "pin");
}

TEST(Export, MakesBlocksWherePinsDoNotFitAndSaysWhy) {
  const std::string design =
      std::string(panel).replace(std::string(panel).find("cell_mm: 12"), 11, "cell_mm: 8");
  expect_refused(design, "--format stl --process fdm --hinge pin", "fits: give --cell-mm ", not_printable);
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --process fdm").code, 0);
  const Json json = print_json_of(scratch);
  EXPECT_EQ(json["hinge"], "block");
  EXPECT_THAT(std::string(json["warnings"][0]), HasSubstr("hinges are blocks, as pins do not fit: "));
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("blocks of tpu95a"))
      << "what FDM prints as rubber";
}

TEST(Export, OfADesignWithoutExactMotionIsCheckedAlongItsEquilibrium) {
  const std::string design = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.45}, {wall: [[1, 1], [2, 1]], t: 0.42}]}
hinge: {model: elastic, k_point: 100, k_turn: 0.1}
drive: {kind: plates, axis: y, compression: 0.03}
)";
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge block").code, 0);
  const Json json = print_json_of(scratch);
  EXPECT_GE(json["path"]["states"], 10);
  EXPECT_NEAR(json["path"]["theta_deg"], std::acos(1 - 0.03) * 180 / M_PI, 1e-6);
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("along the equilibrium of the design's hinges"));
  const auto rigid = HasSubstr("hinges of mjcf turn and do not stretch");
  EXPECT_THAT(json["warnings"].dump(), Not(rigid));
  ASSERT_EQ(exported(scratch, design, "--format stl,mjcf --hinge block").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), rigid);
  ASSERT_EQ(exported(scratch, panel, "--format mjcf").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), Not(rigid)) << "it has an exact motion";
}

TEST(Export, SaysThatAFoldOfOtherCellsIsTheEquilibriumOfItsOwn) {
  const std::string design = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.45}]}
)";
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge block --cell-mm 30").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(),
              HasSubstr("Its fold is the scaled equilibrium of the original size"));
}

/// The result.json of such a design describes its equilibrium.
TEST(Export, SaysHowFarTheEquilibriumIsFromAFoldByTheClosedForm) {
  const std::string words = "folded along its analytic motion: the equilibrium of its elastic hinges";
  const auto warnings = [&](const char* hinge, const char* state) {
    const Scratch scratch;
    const std::string design = std::string(panel) + fmt::format("hinge: {{model: elastic, {}}}\n", hinge);
    EXPECT_EQ(exported(scratch, design, std::string("--format stl --hinge block --state ") + state).code, 0);
    return print_json_of(scratch)["warnings"].dump();
  };
  EXPECT_THAT(warnings("k_point: 2, k_turn: 5", "folded"), HasSubstr(words));
  EXPECT_THAT(warnings("k_point: 2, k_turn: 5", "flat"), Not(HasSubstr(words)));
  EXPECT_THAT(warnings("k_point: 100000, k_turn: 0.001", "folded"), Not(HasSubstr(words)));
}

/// The folded state is unknown. The flat sheet is not written in its place.
TEST(Export, RefusesAFoldedStateThatItsEquilibriumDoesNotReach) {
  const std::string design = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 4, height: 6}}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.35}, {wall: [[1, 1], [2, 1]], t: 0.42}]}
hinge: {model: elastic, k_point: 100, k_turn: 0.1}
drive: {kind: plates, axis: y, compression: 0.45}
)";
  expect_refused(design, "--format stl --hinge block --state folded",
                 "--state folded: the folded state of the design is not known");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge block").code, 0);
  EXPECT_EQ(print_json_of(scratch)["state"], "flat");
}

/// Blocks are sized for the largest turn during the motion. Some hinges turn back before its end.
TEST(Export, MakesBlocksForTheLargestTurnOnTheWay) {
  const Scratch scratch;
  const std::string design = scratch.write("panel.yaml", R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 4, height: 6}}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.4}, {wall: [[1, 1], [2, 1]], t: 0.45}]}
hinge: {model: elastic, k_point: 100, k_turn: 0.1}
drive: {kind: plates, axis: y, compression: 0.3}
)");
  const app::PrintSheet sheet = app::prepared(app::read_design(design), *model::find_process("polyjet"),
                                              {.kind = model::HingeKind::block}, false)
                                    .job.sheet;
  const auto turn_in = [&](const model::State& state, int h) {
    const model::RestHinge& hinge = sheet.linkage.hinges[h];
    return Eigen::AngleAxisd(Eigen::Matrix3d(state[hinge.lower].R.transpose() * state[hinge.upper].R))
        .angle();
  };
  double most_back = 0;  // rad
  for (int h = 0; h < static_cast<int>(sheet.linkage.hinges.size()); ++h) {
    double most = 0;  // rad
    for (const model::State& state : sheet.path) most = std::max(most, turn_in(state, h));
    EXPECT_NEAR(std::abs(sheet.hinges[h].turn), most, 1e-9) << h;
    most_back = std::max(most_back, most - turn_in(sheet.path.back(), h));
  }
  EXPECT_GT(most_back, 0.05);
}

/// The bodies of a twist unit rock, so the upper and lower edges of blocks are stretched more than their middles.
TEST(Export, MakesBlocksThatBearHowTheirBodiesRock) {
  const Scratch scratch;
  const std::string design = scratch.write("twist.yaml", R"(kinetix: 1
structure: {cells: [1, 1], cell_mm: 30, wall_mm: {thickness: 0.8, height: 6}}
design:
  theta_deg: 20
  hinges:
    - {wall: [[0, 0], [1, 0]], alpha_deg: 75}
    - {wall: [[0, 1], [1, 1]], alpha_deg: 75}
    - {wall: [[0, 0], [0, 1]], alpha_deg: 75}
    - {wall: [[1, 0], [1, 1]], alpha_deg: 75}
)");
  const app::PrintSheet sheet = app::prepared(app::read_design(design), *model::find_process("polyjet"),
                                              {.kind = model::HingeKind::block}, false)
                                    .job.sheet;
  ASSERT_FALSE(sheet.is_path_exact);
  for (const model::State& state : sheet.path)
    for (int h = 0; h < 4; ++h) {
      const model::ManufacturedHinge& made = sheet.hinges[h].made;
      EXPECT_LE(hinge_strain(made, sheet.linkage, state, h), made.material.strain_max + 1e-9) << h;
    }
}

TEST(Export, SaysWhereTheDesignsOwnBlocksAreStrainedTooFar) {
  const Scratch scratch;
  const auto panel_with = [](const char* gap) {
    return fmt::format(R"(kinetix: 1
structure: {{cells: [3, 2], cell_mm: 20, wall_mm: {{thickness: 0.8, height: 6}}}}
design: {{theta_deg: 35}}
hinge: {{kind: block, material: tango, gap_mm: {}}}
)",
                       gap);
  };
  ASSERT_EQ(exported(scratch, panel_with("0.8"), "--format stl").code, 0);
  // strain: 70 degrees times half the thickness over the gap
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              ::testing::ContainsRegex("is strained by 0.611 .*, the limit of its material is 0.5"));
  ASSERT_EQ(exported(scratch, panel_with("1.2"), "--format stl").code, 0);
  EXPECT_EQ(text_of(scratch / "out/print.txt").find("strained"), std::string::npos);
}

/// The message for blocks that do not fit does not suggest blocks.
TEST(Export, AdvisesNoOtherHingesWhereTheDesignSaysWhichItHas) {
  const std::string design = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 6, height: 8}}
design: {theta_deg: 50, hinges: [{wall: [[0, 1], [1, 1]], t: 0.42, alpha_deg: 80}]}
hinge: {kind: block, material: tango, gap_mm: 6, thickness_mm: 1}
)";
  const Scratch scratch;
  const Outcome run = exported(scratch, design, "--format stl");
  EXPECT_EQ(run.code, not_printable);
  EXPECT_THAT(run.err, HasSubstr("run into each other"));
  EXPECT_EQ(run.err.find("--hinge block"), std::string::npos) << run.err;
}

TEST(Export, RefusesThetaAtWhichKnucklesMeet) {
  const std::string design =
      std::string(panel).replace(std::string(panel).find("theta_deg: 20"), 13, "theta_deg: 38");
  expect_refused(design, "--format stl --hinge pin", "run into each other at ", not_printable);
}

/// The gap of opposite knuckles is L (cos theta - sin theta) minus their width. Here it equals the clearance, within
/// the error of the polygons.
TEST(Export, SaysFromWhichThetaOnSolidsAreTooNear) {
  const Scratch scratch;
  const std::string design =
      std::string(panel).replace(std::string(panel).find("theta_deg: 20"), 13, "theta_deg: 38");
  const Outcome run = exported(scratch, design, "--format stl --hinge pin");
  std::smatch from;
  ASSERT_TRUE(std::regex_search(
      run.err, from,
      std::regex(R"(come nearer to each other than 0.05 mm from a fold angle of ([0-9.]+) deg on)")))
      << run.err;
  const double knuckle = 1 + 2 * (0.05 + 0.6), asked = 0.05 - 0.01, share = (knuckle + asked) / 12;
  const double closed_form = 180 / M_PI * std::acos(share / std::sqrt(2)) - 45;
  EXPECT_NEAR(std::stod(from[1]), closed_form, 0.25) << "0.02 mm of polygons, 0.1 degrees of rounding";
}

/// One block among pins: the pins must still keep their clearance.
TEST(Export, HoldsPinsBesideABlockToTheirOwnClearance) {
  std::string design = panel;
  design.replace(
      design.find("{theta_deg: 20}"), 15,
      "{theta_deg: 38, hinges: [{wall: [[0, 0], [1, 0]], hinge: {kind: block, material: tango, gap_mm: "
      "3, thickness_mm: 0.8, height_mm: 6}}]}");
  expect_refused(design, "--format stl --hinge pin",
                 "come nearer to each other than 0.05 mm from a fold angle of", not_printable);
  design.replace(design.find("38"), 2, "20");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge pin").code, 0);
  const Json json = print_json_of(scratch);
  EXPECT_EQ(json["path"]["in_hinges"]["asked_mm"], 0.05);
  EXPECT_EQ(json["path"]["elsewhere"]["asked_mm"], 0.05);
  EXPECT_TRUE(json["swelling_mm"].is_null()) << "its parts are joined";
}

/// A sheet of blocks with films in its creases.
TEST(Export, NamesEachKindOfHingeAndTheMaterialThatItsFilesMix) {
  std::string design = panel;
  design.replace(
      design.find("{theta_deg: 20}"), 15,
      "{theta_deg: 10, hinges: [{wall: [[0, 0], [1, 0]], hinge: {kind: film, material: pp, gap_mm: "
      "2, thickness_mm: 0.4, height_mm: 6}}]}\nhinge: {kind: block, material: tango, gap_mm: 1.5}");
  const Scratch scratch;
  const Outcome run = exported(scratch, design, "--format stl --process polyjet");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string words = text_of(scratch / "out/print.txt");
  EXPECT_THAT(words, HasSubstr("blocks of tango: gap 1.5 mm"));
  EXPECT_THAT(words, HasSubstr("1 living hinges of pp: gap 2 mm, thickness 0.4 mm"));
  EXPECT_THAT(words, HasSubstr("living hinges of pp and blocks of tango are one soft part in the files"));
  EXPECT_THAT(words, HasSubstr("polyjet prints soft parts of tango"));
}

/// Ends of walls at blocks have no minimum distance and may be nearer than a pin's clearance.
TEST(Export, SaysHowNearPartsComeThatNeedNotKeepApart) {
  const auto fold_mm = [](const std::string& own) {
    std::string design = panel;
    design.replace(design.find("{theta_deg: 20}"), 15,
                   "{theta_deg: 30" + own + "}\nhinge: {kind: block, material: tango, gap_mm: 0.6}");
    const Scratch scratch;
    EXPECT_EQ(exported(scratch, design, "--format stl").code, 0);
    std::smatch found;
    const std::string text = text_of(scratch / "out/print.txt");
    EXPECT_TRUE(std::regex_search(text, found, std::regex("motion +solids stay ([0-9.]+) mm apart"))) << text;
    return found.empty() ? 0 : std::stod(found[1]);
  };
  const double blocks = fold_mm("");
  EXPECT_LT(blocks, 0.25);
  EXPECT_EQ(fold_mm(", hinges: [{wall: [[0, 0], [1, 0]], hinge: {kind: pin, diameter_mm: 1, clearance_mm: "
                    "0.3}}]"),
            blocks);
}

/// The text describes the most frequent kind of hinge, wherever the others are.
TEST(Export, SaysTheClearanceAndStiffnessOfMostHinges) {
  std::string design = panel;
  design.replace(
      design.find("{theta_deg: 20}"), 15,
      "{theta_deg: 10, hinges: [{wall: [[0, 0], [1, 0]], hinge: {kind: film, material: pp, gap_mm: "
      "2, thickness_mm: 0.4, height_mm: 6}}]}\nhinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}");
  const Scratch mixed, pins;
  ASSERT_EQ(exported(mixed, design, "--format stl --process polyjet").code, 0);
  const std::string of_pins = std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}\n";
  ASSERT_EQ(exported(pins, of_pins, "--format stl --process polyjet").code, 0);
  const Json said = print_json_of(mixed);
  EXPECT_EQ(said["hinge"], "pin");
  EXPECT_EQ(said["clearance_mm"], 0.1);
  EXPECT_EQ(said["k"], print_json_of(pins)["k"]);
}

TEST(Export, SaysThatSlsPrintsFilmsOfItsOwnMaterial) {
  std::string design = panel;
  design.replace(design.find("{theta_deg: 20}"), 15,
                 "{theta_deg: 10}\nhinge: {kind: film, material: pp, gap_mm: 2.5, thickness_mm: 0.5}");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --process sls").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(),
              HasSubstr("sls prints walls and living hinges in one, of pa12"));
}

TEST(Export, SaysThatANozzleLaysNoFilmsThinnerThanItsLine) {
  for (const auto& [process, mm, reported] :
       {std::tuple{"fdm", "0.3", true}, {"fdm", "0.4", false}, {"sla", "0.3", false}}) {
    const Scratch scratch;
    const std::string hinge =
        "hinge: {kind: film, material: pp, gap_mm: 3, thickness_mm: " + std::string(mm) + "}\n";
    ASSERT_EQ(
        exported(scratch, std::string(panel) + hinge, std::string("--format stl --process ") + process).code,
        0);
    const std::string warnings = print_json_of(scratch)["warnings"].dump(),
                      words = "living hinges of 0.3 mm are thinner than the line of 0.4 mm";
    EXPECT_EQ(warnings.find(words) != std::string::npos, reported) << process << mm << warnings;
  }
}

/// A block that is long enough to cross the wall of another body.
TEST(PathClearance, CountsBlocks) {
  const Scratch scratch;
  app::PreparedPrint print =
      app::prepared(app::read_design(scratch.write("panel.yaml", panel)), *model::find_process("polyjet"),
                    {.kind = model::HingeKind::block}, false);
  app::PrintSheet& sheet = print.job.sheet;
  ASSERT_TRUE(has_required_clearance(print.clearance));
  ASSERT_TRUE(has_required_clearance(path_clearance(sheet))) << "as it was";
  for (Eigen::Vector3d& p : sheet.soft[0].points) p.x() += p.x() > 6 ? 12 : 0;
  const app::PathClearance wrong = path_clearance(sheet);
  EXPECT_FALSE(has_required_clearance(wrong));
  EXPECT_EQ(wrong.first_violation->theta, 0);
  EXPECT_THAT(part_name(sheet, std::max(wrong.least().first, wrong.least().second)),
              HasSubstr("soft part of "));
}

/// Loose rods have the volume of rods that are part of a fork: bores and rods have the same circle, within the error of
/// the polygons.
TEST(Export, MakesLooseRodsThatFillTheBoresOfTheirForks) {
  const Scratch captive, loose;
  ASSERT_EQ(exported(captive, panel, "--format stl --hinge pin").code, 0);
  ASSERT_EQ(exported(loose, panel, "--format stl --hinge pin --loose-rods").code, 0);
  const Json one = Json::parse(text_of(captive / "out/print.json")),
             other = Json::parse(text_of(loose / "out/print.json"));
  EXPECT_EQ(one["loose_rods"], 0);
  EXPECT_EQ(other["loose_rods"], other["hinges"]);
  const double rods = volume_of_stl(text_of(loose / "out/rods.stl")),
               forks = volume_of_stl(text_of(loose / "out/hard.stl"));
  EXPECT_NEAR(rods, 17 * M_PI / 4 * 6, 0.02 * 17 * M_PI / 4 * 6) << "17 rods of 1 x 6 mm, as polygons";
  EXPECT_NEAR((forks + rods) / double(one["volume_mm3"]["hard"]), 1, 2e-3) << "each rod in one file alone";
  EXPECT_NEAR(forks / double(other["volume_mm3"]["hard"]), 1, 1e-6);
  EXPECT_FALSE(fs::exists(captive / "out/rods.stl"));
}

TEST(Export, RefusesPinsWithoutRoomForAnEyeAndSaysHowHighTheirWallsHaveToBe) {
  std::string low = panel;
  low.replace(low.find("height: 6"), 9, "height: 1.5");
  low.replace(low.find("cell_mm: 12"), 11, "cell_mm: 30");
  const std::string pins = "--format stl --hinge pin --process fdm";
  expect_refused(low, pins, "a pin 1.5 mm high has no room for an eye between two clearances of 0.53 mm",
                 not_printable);
  expect_refused(low, pins, "x 2.12 mm a cell_mm of 30 fits: give --cell-mm 30", not_printable);
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, low, pins + " --cell-mm 30").code, 0);
  EXPECT_NEAR(double(print_json_of(scratch)["bounds_mm"][2]), 2.12, 1e-6) << "in floats";
}

/// All walls lean to the same side. The sheet has no exact motion, so its hinges stretch.
TEST(Export, SaysWhatToChangeInADesignWhoseOwnPinsWouldStretch) {
  const std::string leaning = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 30, wall_mm: {thickness: 2, height: 12}}
design: {theta_deg: 20, hinges: [{wall: [[1, 0], [2, 0]], beta_deg: 30}, {wall: [[1, 1], [2, 1]], beta_deg: 30}, {wall: [[1, 2], [2, 2]], beta_deg: 30}]}
)";
  const std::string own = leaning + "hinge: {kind: pin, diameter_mm: 2, clearance_mm: 0.2}\n";
  for (const char* options : {"--format stl", "--format stl --hinge block"})
    expect_refused(own, options, "Change its `hinge:` to `kind: block`, or remove it and give --hinge block",
                   not_printable);
  expect_refused(leaning, "--format stl --hinge pin", "pins cannot. Give --hinge block", not_printable);
}

}  // namespace
}  // namespace kinetix::testing
