#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/print/fit.hpp"
#include "app/print/format/zip_text.hpp"
#include "app/print/overhang.hpp"
#include "app/print/sheet/raised_text.hpp"
#include "app/print/slicer.hpp"
#include "app/report/report.hpp"
#include "model/base/invalid_input.hpp"
#include "model/linkage/state.hpp"
#include "model/matter/hinge_strain.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* panel = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 12, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 20}
)";

Outcome exported(const Scratch& scratch, const std::string& design, const std::string& options) {
  return kinetix_opt("export " + scratch.write("panel.yaml", design) + " -o " + std::string(scratch / "out") +
                     " " + options);
}

/// A refusal: one line, exit code 2, nothing written. Quiet, since a slow machine may say before what it is busy with.
void expect_refused(const std::string& design, const std::string& options, const std::string& says) {
  const Scratch scratch;
  const Outcome run = exported(scratch, design, options + " --quiet");
  EXPECT_EQ(run.code, 2) << run.out << run.err;
  EXPECT_THAT(run.err, HasSubstr(says));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_FALSE(fs::exists(scratch / "out")) << says;
}

TEST(Export, WritesTheSameBytesAgain) {
  const Scratch scratch;
  std::vector<std::string> bytes[2];
  for (auto& files : bytes) {
    const Outcome run = exported(scratch, panel, "--format all --process sla");
    ASSERT_EQ(run.code, 0) << run.err;
    for (const char* name : {"all.stl", "hard.stl", "panel.3mf", "panel.step", "panel.svg", "panel.pdf",
                             "panel.dxf", "panel.xml", "panel.glb", "panel.scad", "print.json", "print.txt"})
      files.push_back(text_of(scratch / (std::string("out/") + name)));
  }
  for (std::size_t k = 0; k < bytes[0].size(); ++k) {
    EXPECT_FALSE(bytes[0][k].empty()) << k;
    EXPECT_TRUE(bytes[0][k] == bytes[1][k]) << k;
  }
}

/// print.json, which its schema allows.
Json said_of(const Scratch& scratch) {
  Json json = Json::parse(text_of(scratch / "out/print.json"));
  EXPECT_EQ(schema_errors(json, "print"), "");
  return json;
}

/// Along x, mm.
double width_of_stl(const std::string& bytes) {
  float least = INFINITY, most = -INFINITY;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    float n[12];
    std::memcpy(n, bytes.data() + at, sizeof n);
    for (const int k : {3, 6, 9}) {
      least = std::min(least, n[k]);
      most = std::max(most, n[k]);
    }
  }
  return most - least;
}

TEST(Export, SaysTheVolumesOfItsFiles) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge block").code, 0);
  const Json json = said_of(scratch);
  EXPECT_EQ(json["schema"], "kinetix-print/1");
  EXPECT_EQ(json["bodies"], 12);
  EXPECT_EQ(json["hinges"], 17);
  const double hard = volume_of_stl(text_of(scratch / "out/hard.stl")),
               soft = volume_of_stl(text_of(scratch / "out/soft.stl")),
               all = volume_of_stl(text_of(scratch / "out/all.stl"));
  EXPECT_NEAR(hard / double(json["volume_mm3"]["hard"]), 1, 1e-9);
  EXPECT_NEAR(soft / double(json["volume_mm3"]["soft"]), 1, 1e-6);
  EXPECT_NEAR((hard + soft) / all, 1, 1e-6);
}

/// The radius is the slicer's own, or less where that would close the pins.
TEST(Export, NamesTheSettingsThatKeepGapsOpen) {
  for (const auto& [process, radius_mm, foot_mm] :
       {std::tuple{"polyjet", 0.4 * 0.05, 0.0}, {"sla", 0.049, 0.2}}) {
    const Scratch scratch;
    const std::string choice = std::string("--hinge pin --process ") + process;
    ASSERT_EQ(exported(scratch, panel, "--format 3mf " + choice).code, 0);
    const Json said = said_of(scratch)["gap_settings"];
    EXPECT_NEAR(said["closing_radius_mm"], radius_mm, 1e-12);
    EXPECT_EQ(said["elephant_foot_compensation_mm"], foot_mm);
    EXPECT_EQ(said["xy_compensation_mm"], 0);
    EXPECT_THAT(text_of(scratch / "out/print.txt"),
                HasSubstr(fmt::format("gap closing radius {:g} mm, elephant foot compensation {:g} mm",
                                      radius_mm, foot_mm)));
    const std::string config = app::text_in_zip(scratch / "out/panel.3mf", "Metadata/Slic3r_PE_model.config");
    for (const auto& [key, mm] : {std::pair{"slice_closing_radius", radius_mm},
                                  {"elefant_foot_compensation", foot_mm},
                                  {"xy_size_compensation", 0.0}})
      EXPECT_THAT(config, HasSubstr(fmt::format("key=\"{}\" value=\"{:g}\"", key, mm)));
  }
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format 3mf --hinge block").code, 0);
  EXPECT_TRUE(said_of(scratch)["gap_settings"].is_null());
}

/// Rods of their own hold as much as those that are part of a fork: bores and rods have the same circle but for polygons.
TEST(Export, MakesLooseRodsThatFillTheBoresOfTheirForks) {
  const Scratch captive, loose;
  ASSERT_EQ(exported(captive, panel, "--format stl --hinge pin").code, 0);
  ASSERT_EQ(exported(loose, panel, "--format stl --hinge pin --loose-rods").code, 0);
  const Json one = Json::parse(text_of(captive / "out/print.json")),
             other = Json::parse(text_of(loose / "out/print.json"));
  EXPECT_EQ(one["loose_rods"], 0);
  EXPECT_EQ(other["loose_rods"], other["hinges"]);
  EXPECT_NEAR(double(other["volume_mm3"]["hard"]) / double(one["volume_mm3"]["hard"]), 1, 2e-3);
  EXPECT_NEAR(volume_of_stl(text_of(loose / "out/rods.stl")), 17 * M_PI / 4 * 6, 0.02 * 17 * M_PI / 4 * 6)
      << "17 rods of 1 x 6 mm, as polygons";
  EXPECT_FALSE(fs::exists(captive / "out/rods.stl"));
}

TEST(Export, RefusesOptionsThatAreNoNumbersInOneLine) {
  for (const char* option : {"--cell-mm nan", "--clearance nan", "--bed nan,100", "--clearance 0.001",
                             "--cell-mm x", "--state half", "--bed 5"})
    expect_refused(panel, std::string("--format stl ") + option, "(see --help)");
}

TEST(Export, RefusesPinsWithoutRoomForAnEyeAndSaysHowHighTheirWallsHaveToBe) {
  std::string low = panel;
  low.replace(low.find("height: 6"), 9, "height: 1.5");
  low.replace(low.find("cell_mm: 12"), 11, "cell_mm: 30");
  const std::string pins = "--format stl --hinge pin --process fdm";
  expect_refused(low, pins, "a pin 1.5 mm high has no room for an eye between two clearances of 0.53 mm");
  expect_refused(low, pins, "x 2.12 mm a cell_mm of 30.5 would do (kinetix-opt export --cell-mm 30.5)");
  expect_refused(low, pins, "export --cell-mm 30.5): the sheet and what it folds to are 1.02 times as large");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, low, pins + " --cell-mm 30.5").code, 0);
  EXPECT_NEAR(double(said_of(scratch)["bounds_mm"][2]), 2.12, 1e-6) << "in floats";
}

TEST(Export, TakesTheClearanceOfACouponInsteadOfTheProcesss) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --process sla --hinge pin --clearance 0.15").code, 0);
  const Json json = said_of(scratch);
  EXPECT_EQ(json["clearance_mm"], 0.15);
  EXPECT_EQ(json["process"], "sla");
  EXPECT_NEAR(json["path"]["in_hinges"]["mm"], 0.15, 0.01) << "measured on the solids";
  const std::string described =
      std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.2}\n";
  ASSERT_EQ(exported(scratch, described, "--format stl --process sla --clearance 0.15").code, 0);
  EXPECT_EQ(said_of(scratch)["clearance_mm"], 0.2) << "the design's own, which this printer can";
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("--clearance 0.15 leaves the design's own pins as they are"));
  expect_refused(described, "--format stl --process sla --clearance 0.3",
                 "the design's own pins have a clearance of 0.2 mm, and --clearance asks for 0.3: change "
                 "`clearance_mm` in the design");
  const Outcome coupon =
      kinetix_opt("export --coupon --format stl --clearance 0.2 -o " + std::string(scratch / "coupon"));
  EXPECT_EQ(coupon.code, 2);
  EXPECT_THAT(coupon.err, HasSubstr("a coupon has gaps of its own"));
}

TEST(Export, WritesACouponAsA3mfWhereNoFormatIsGiven) {
  const Scratch scratch;
  const Outcome coupon = kinetix_opt("export --coupon -o " + std::string(scratch / "coupon"));
  EXPECT_EQ(coupon.code, 0) << coupon.err;
  EXPECT_TRUE(fs::exists(scratch / "coupon/coupon.3mf"));
  expect_refused(panel, "", "--format is required, e.g. --format 3mf");
}

TEST(Export, RefusesOptionsOfDesignsForACoupon) {
  const Scratch scratch;
  for (const char* option :
       {"--hinge block", "--cell-mm 30", "--loose-rods", "--state folded", "--caps", "--clearance 0.2"}) {
    const Outcome coupon =
        kinetix_opt(fmt::format("export --coupon {} -o {}", option, std::string(scratch / "coupon")));
    EXPECT_EQ(coupon.code, 2) << option;
    EXPECT_THAT(coupon.err, HasSubstr("of designs: a coupon")) << option;
    EXPECT_FALSE(fs::exists(scratch / "coupon"));
  }
}

/// Its hinges stay whole: each tile has as much of the coupon as it has hinges.
TEST(Export, CutsACouponIntoTilesBetweenItsHinges) {
  const Scratch scratch;
  const std::string coupon = "export --coupon --process sla --format stl -o " + std::string(scratch / "out");
  const Outcome whole = kinetix_opt(coupon);
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("(kinetix-opt export --bed 145,145) it is cut into tiles"));
  const Outcome cut = kinetix_opt(coupon + " --bed 145,145");
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.out, HasSubstr("2 x 1, one bed each: no hinge is between two of them"));
  EXPECT_EQ(cut.out.find("larger than the bed"), std::string::npos);
  double parts = 0;  // mm^3
  for (const char* tile : {"out/tile_1.stl", "out/tile_2.stl"})
    parts += volume_of_stl(text_of(scratch / tile));
  EXPECT_NEAR(parts / volume_of_stl(text_of(scratch / "out/all.stl")), 1, 1e-6);
}

TEST(Export, SaysWhichOptionsChangeNothing) {
  const Scratch scratch;
  const std::string described =
      std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.2}\n";
  ASSERT_EQ(exported(scratch, described, "--format stl --hinge block").code, 0);
  EXPECT_EQ(said_of(scratch)["hinge"], "pin");
  EXPECT_THAT(said_of(scratch)["warnings"].dump(), HasSubstr("--hinge changes nothing: the design says"));
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge block --clearance 0.2 --loose-rods").code, 0);
  const std::string said = said_of(scratch)["warnings"].dump();
  EXPECT_THAT(said, HasSubstr("--clearance changes nothing: no hinge is a pin"));
  EXPECT_THAT(said, HasSubstr("--loose-rods changes nothing: no hinge is a pin"));
  ASSERT_EQ(exported(scratch, panel, "--format stl --caps").code, 0);
  EXPECT_THAT(said_of(scratch)["warnings"].dump(),
              HasSubstr("--caps changes nothing: all axes are in the middle"));
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --clearance 0.2 --loose-rods").code, 0);
  EXPECT_EQ(said_of(scratch)["warnings"].dump().find("changes nothing"), std::string::npos);
}

TEST(Export, SaysThatOtherCellsMakeTheSheetLargerOrSmaller) {
  const Scratch scratch;
  for (const auto& [edge_mm, words] :
       {std::pair{"30",
                  "made with cells of 30 mm instead of 12: the sheet and what it folds to are 2.5 times as "
                  "large; for the size that its goal asked for search again with fewer cells"},
        {"9",
         "are 0.75 times as large; for the size that its goal asked for search again with more cells"}}) {
    ASSERT_EQ(exported(scratch, panel, std::string("--format stl --hinge block --cell-mm ") + edge_mm).code,
              0);
    EXPECT_THAT(said_of(scratch)["warnings"].dump(), HasSubstr(words));
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr(words));
  }
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge block --cell-mm 12").code, 0);
  EXPECT_EQ(said_of(scratch)["warnings"].dump().find("times as large"), std::string::npos);
}

TEST(Export, SaysThatDrawingsAreAlwaysFlat) {
  const Scratch scratch;
  const std::string folded = "--hinge block --state folded --format ";
  ASSERT_EQ(exported(scratch, panel, folded + "svg,dxf,stl").code, 0);
  EXPECT_THAT(said_of(scratch)["warnings"].dump(),
              HasSubstr("--state folded changes nothing in svg and dxf, which always draw the flat sheet"));
  ASSERT_EQ(exported(scratch, panel, folded + "stl").code, 0);
  EXPECT_EQ(said_of(scratch)["warnings"].dump().find("changes nothing"), std::string::npos);
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("orientation  folded, as its motion leaves it, as it"));
}

/// By the overhang as the sheet lies, and by what the process lays under it itself.
TEST(Export, AsksForSupportsWhereTheProcessNeedsThem) {
  for (const auto& [options, words] :
       {std::pair{"--process fdm --hinge block", "supports     none\n"},
        {"--process fdm --hinge pin --cell-mm 30",
         "supports     under the {:.1f} mm2 that lean more than 45 degrees"},
        {"--process sla --hinge pin", "supports     under the {:.1f} mm2 that lean more than 45 degrees"},
        {"--process polyjet --hinge pin",
         "none to plan: support material that the printer lays down by itself "
         "carries the {:.1f} mm2"},
        {"--process sls --hinge pin --cell-mm 30", "none to plan: the powder carries the {:.1f} mm2"}}) {
    const Scratch scratch;
    ASSERT_EQ(exported(scratch, panel, std::string("--format stl ") + options).code, 0);
    const double hangs = said_of(scratch)["overhang_mm2"]["flat"];
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr(fmt::format(fmt::runtime(words), hangs)))
        << options;
  }
}

/// Walls that lean all alike: no exact motion, so hinges stretch.
TEST(Export, SaysWhatToChangeInADesignWhoseOwnPinsWouldStretch) {
  const std::string leaning = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 30, wall_mm: {thickness: 2, height: 12}}
design: {theta_deg: 20, hinges: [{wall: [[1, 0], [2, 0]], beta_deg: 30}, {wall: [[1, 1], [2, 1]], beta_deg: 30}, {wall: [[1, 2], [2, 2]], beta_deg: 30}]}
)";
  const std::string own = leaning + "hinge: {kind: pin, diameter_mm: 2, clearance_mm: 0.2}\n";
  for (const char* options : {"--format stl", "--format stl --hinge block"})
    expect_refused(own, options,
                   "change its `hinge:` to `kind: block`, or take it out and give --hinge block");
  expect_refused(leaning, "--format stl --hinge pin", "pins cannot (kinetix-opt export --hinge block)");
}

TEST(Export, MakesADesignForItsOwnProcess) {
  const Scratch scratch;
  const std::string design = std::string(panel) + "process: sla\n";
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge pin").code, 0);
  EXPECT_EQ(said_of(scratch)["process"], "sla");
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge pin --process polyjet").code, 0);
  EXPECT_EQ(said_of(scratch)["process"], "polyjet");
  expect_refused(std::string(panel) + "process: fdmm\n", "--format stl", "did you mean `fdm`?");
  const std::string folder = scratch / "result";
  ASSERT_EQ(kinetix_opt("simulate " + scratch.write("own.yaml", design) + " -o " + folder).code, 0);
  EXPECT_THAT(text_of(folder + "/design.yaml"), HasSubstr("process: sla\n")) << "and keeps it";
  EXPECT_EQ(kinetix_opt("simulate " + folder + " -o " + std::string(scratch / "again")).code, 0);
  for (const std::string& source : {folder, folder + "/result.json"}) {
    const Outcome made = kinetix_opt("export " + source + " --format stl --hinge pin --quiet -o " +
                                     std::string(scratch / "made"));
    EXPECT_EQ(made.code, 0) << source << made.err;
    EXPECT_EQ(Json::parse(text_of(scratch / "made/print.json"))["process"], "sla");
    fs::remove_all(scratch / "made");
  }
  const Outcome refused = kinetix_opt("simulate " + scratch.path() + " -o " + std::string(scratch / "none"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("no design.yaml in this folder"));
}

TEST(Export, CutsALargeSheetIntoTilesThatTheBedHolds) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl,3mf --hinge pin --bed 28,30").code, 0);
  const Json json = said_of(scratch);
  EXPECT_EQ(json["tiles"], Json::array({2, 1}));
  EXPECT_EQ(json["loose_rods"], 3) << "between the two columns in the middle";
  double tiles = 0;
  for (const char* name : {"out/tile_1.stl", "out/tile_2.stl"}) {
    const std::string bytes = text_of(scratch / name);
    tiles += volume_of_stl(bytes);
    EXPECT_LE(width_of_stl(bytes), 28);
  }
  tiles += volume_of_stl(text_of(scratch / "out/rods.stl"));
  EXPECT_NEAR(tiles / double(json["volume_mm3"]["hard"]), 1, 1e-6);
  for (const char* name : {"out/panel_tile_2.3mf", "out/panel_rods.3mf"})
    EXPECT_TRUE(fs::exists(scratch / name));
  expect_refused(panel, "--format stl --bed 10,10", "a bed of 10 x 10 mm does not hold a body");
}

/// Its own size along x and y, as print.json has it, up to whole mm.
std::pair<int, int> whole_mm(const Json& json) {
  return {static_cast<int>(std::ceil(double(json["bounds_mm"][0]))),
          static_cast<int>(std::ceil(double(json["bounds_mm"][1])))};
}

TEST(Export, LeavesASheetWholeThatTheBedHolds) {
  for (const char* hinge : {"pin", "block", "film"}) {
    const Scratch scratch;
    const std::string options = std::string("--format stl --hinge ") + hinge;
    ASSERT_EQ(exported(scratch, panel, options).code, 0);
    const auto [x, y] = whole_mm(said_of(scratch));
    for (const std::string& bed : {fmt::format("{},{}", x, y), fmt::format("{},{}", y, x)}) {
      ASSERT_EQ(exported(scratch, panel, options + " --bed " + bed).code, 0);
      EXPECT_EQ(said_of(scratch)["tiles"], Json::array({1, 1})) << hinge << " " << bed;
      EXPECT_FALSE(fs::exists(scratch / "out/tile_1.stl"));
    }
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("holds the whole, turned on it by a quarter"));
    ASSERT_EQ(exported(scratch, panel, options + fmt::format(" --bed {},{}", x - 1, y)).code, 0);
    EXPECT_EQ(said_of(scratch)["tiles"], Json::array({2, 1})) << hinge;
    for (const char* tile : {"out/tile_1.stl", "out/tile_2.stl"})
      EXPECT_GT(volume_of_stl(text_of(scratch / tile)), 0) << hinge;
  }
}

TEST(Export, SaysThatTheBedIsTooSmallAndNotThatLargerCellsAreNone) {
  const Scratch scratch;
  const Outcome run = exported(scratch, panel, "--format stl --hinge pin --bed 10,10");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("smaller cells (kinetix-opt export --cell-mm)"));
  EXPECT_EQ(run.err.find("larger cell"), std::string::npos) << run.err;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --bed 15,15").code, 0);
  EXPECT_EQ(said_of(scratch)["tiles"], Json::array({4, 3})) << "a body each";
}

/// Files that come with some sheets only would be taken for parts of the new one.
TEST(Export, TakesAwayTilesOfAnEarlierExportThatAreNotItsOwn) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl,3mf --hinge pin --bed 28,30").code, 0);
  std::ofstream(scratch / "out/tile_2.stl") << "mine";
  std::ofstream(scratch / "out/tile_3.stl") << "mine too";
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin").code, 0);
  for (const char* gone : {"out/tile_1.stl", "out/rods.stl"})
    EXPECT_FALSE(fs::exists(scratch / gone)) << gone;
  for (const char* kept :
       {"out/tile_2.stl", "out/tile_3.stl", "out/panel.3mf", "out/panel_tile_1.3mf", "out/panel_rods.3mf"})
    EXPECT_TRUE(fs::exists(scratch / kept))
        << kept << ", changed by hand, or of a format that is not written";
  ASSERT_EQ(exported(scratch, panel, "--format 3mf --hinge pin").code, 0);
  for (const char* gone : {"out/panel_tile_1.3mf", "out/panel_rods.3mf", "out/.kinetix-prints"})
    EXPECT_FALSE(fs::exists(scratch / gone)) << gone;
}

TEST(Export, GluesBlocksBetweenTiles) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge block --bed 28,30").code, 0);
  const Json json = said_of(scratch);
  double soft = 0;
  for (const char* name : {"out/tile_1_soft.stl", "out/tile_2_soft.stl"})
    soft += volume_of_stl(text_of(scratch / name));
  EXPECT_NEAR(soft / double(json["volume_mm3"]["soft"]), 1, 1e-6);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("2 x 1, one bed each: glue the soft parts"));
}

/// Pins in the lower walls, blocks in the upper: a cut through both needs rods and glue.
TEST(Export, SaysHowTilesOfSeveralKindsOfHingesJoin) {
  const Scratch scratch;
  const std::string design = R"(kinetix: 1
structure: {cells: [4, 1], cell_mm: 20, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 5, hinges: [
  {wall: [[0, 0], [1, 0]], hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}},
  {wall: [[1, 0], [2, 0]], hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}},
  {wall: [[2, 0], [3, 0]], hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}},
  {wall: [[3, 0], [4, 0]], hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}}]}
hinge: {kind: block, material: tango, gap_mm: 2}
)";
  const Outcome run = exported(scratch, design, "--format stl --bed 60,60");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out,
              HasSubstr("push a rod through each pin between two of them, and glue the soft parts there"));
}

TEST(Export, KeepsToTheLimitsOfOnesOwnPrinter) {
  const std::string design = std::string(panel) + "process: {clearance_mm: 0.2}\n";
  for (const char* options : {"--format stl --hinge pin", "--format stl --hinge pin --process polyjet"}) {
    const Scratch scratch;
    ASSERT_EQ(exported(scratch, design, options).code, 0);
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("clearance 0.2 mm a side")) << options;
  }
  expect_refused(std::string(panel) + "process: {base: fdm, least_wall_mm: 0.9}\n", "--format stl",
                 "a wall of 0.8 mm is less than fdm prints, 0.9 mm");
}

TEST(Export, RefusesWhatItCannotMake) {
  expect_refused(panel, "--format stepp", "unknown format `stepp` (did you mean `step`?)");
  expect_refused(panel, "--format stl --process fdmm", "unknown process `fdmm` (did you mean `fdm`?)");
  expect_refused(panel, "--format stl --hinge peg", "unknown hinge `peg`");
  const std::string thin = std::string(panel).replace(std::string(panel).find("0.8"), 3, "0.5");
  expect_refused(thin, "--format stl --process fdm", "a wall of 0.5 mm is less than fdm prints, 0.8 mm");
  expect_refused(std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.05}\n",
                 "--format stl --process sla", "a clearance of 0.05 mm is less than sla prints, 0.25 mm");
  expect_refused(std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.4}\n",
                 "--format stl --process fdm", "a rod of 1 mm is less than fdm prints, 3 mm");
}

/// Thin walls of the same plastic: one extruder, nothing to glue.
TEST(Export, MakesFilmsOfTheWallsMaterialWhereTheProcessPrintsThem) {
  for (const auto& [process, material, volumes] :
       {std::tuple{"fdm", "pp", 1}, {"sls", "pa12", 1}, {"polyjet", "pp", 2}, {"sla", "pp", 2}}) {
    const Scratch scratch;
    const std::string choice = std::string("--hinge film --process ") + process;
    ASSERT_EQ(exported(scratch, panel, "--format 3mf " + choice).code, 0);
    const std::string config = app::text_in_zip(scratch / "out/panel.3mf", "Metadata/Slic3r_PE_model.config");
    EXPECT_EQ(config.find("key=\"extruder\" value=\"2\"") == std::string::npos, volumes == 1) << process;
    const std::string text = text_of(scratch / "out/print.txt");
    EXPECT_THAT(text, HasSubstr(std::string("films of ") + material + ":"));
    EXPECT_EQ(text.find("to be glued") != std::string::npos, std::string(process) == "sla") << text;
  }
}

/// Of a sheet in memory: files have at least one wall.
TEST(Export, RefusesADesignWithoutHinges) {
  const Scratch scratch;
  app::DesignFile design = app::read_design(scratch.write("panel.yaml", panel));
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
  expect_refused(design, "--format stl --hinge pin", "overlaps the junction at vertex [0, 0]");
  const Scratch scratch;
  const Outcome refused = exported(scratch, design, "--format stl --hinge pin");
  std::smatch edge;
  ASSERT_TRUE(std::regex_search(refused.err, edge,
                                std::regex(R"(would do \(kinetix-opt export --cell-mm ([0-9.]+)\))")))
      << refused.err;
  EXPECT_EQ(exported(scratch, design, "--format stl --hinge pin --cell-mm " + edge.str(1)).code, 0);
  const double less = std::stod(edge.str(1)) - 0.5;
  EXPECT_EQ(exported(scratch, design, "--format stl --hinge pin --cell-mm " + std::to_string(less)).code, 2);
}

TEST(Export, MakesBlocksWherePinsDoNotFitAndSaysWhy) {
  const std::string design =
      std::string(panel).replace(std::string(panel).find("cell_mm: 12"), 11, "cell_mm: 8");
  expect_refused(design, "--format stl --process fdm --hinge pin", "would do (kinetix-opt export --cell-mm ");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --process fdm").code, 0);
  const Json json = said_of(scratch);
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
  const Json json = said_of(scratch);
  EXPECT_GE(json["path"]["states"], 10);
  EXPECT_NEAR(json["path"]["theta_deg"], std::acos(1 - 0.03) * 180 / M_PI, 1e-6);
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("along the equilibrium of the design's hinges"));
}

TEST(Export, SaysThatAFoldOfOtherCellsIsTheEquilibriumOfItsOwn) {
  const std::string design = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.45}]}
)";
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge block --cell-mm 30").code, 0);
  EXPECT_THAT(said_of(scratch)["warnings"].dump(),
              HasSubstr("its fold is the equilibrium at its own size, scaled"));
}

/// The flat sheet is not written as the folded one, of which nothing is known.
TEST(Export, RefusesAFoldedStateThatItsEquilibriumDoesNotReach) {
  const std::string design = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 4, height: 6}}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.35}, {wall: [[1, 1], [2, 1]], t: 0.42}]}
hinge: {model: elastic, k_point: 100, k_turn: 0.1}
drive: {kind: plates, axis: y, compression: 0.45}
)";
  expect_refused(design, "--format stl --hinge block --state folded",
                 "--state folded: how the design looks when it is folded is not known");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge block").code, 0);
  EXPECT_EQ(said_of(scratch)["state"], "flat");
}

/// Blocks are made for the largest turn on the way, where hinges turn back before the end.
TEST(Export, MakesBlocksForTheLargestTurnOnTheWay) {
  const Scratch scratch;
  const std::string design = scratch.write("panel.yaml", R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 20, wall_mm: {thickness: 4, height: 6}}
design: {theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], t: 0.35}, {wall: [[1, 1], [2, 1]], t: 0.42}]}
hinge: {model: elastic, k_point: 100, k_turn: 0.1}
drive: {kind: plates, axis: y, compression: 0.3}
)");
  const app::PrintSheet sheet = app::prepared(app::read_design(design), *model::find_process("polyjet"),
                                              {.kind = model::HingeKind::block}, false)
                                    .job.sheet;
  const auto turn_in = [&](const model::State& state) {
    const model::RestHinge& hinge = sheet.linkage.hinges[0];
    return Eigen::AngleAxisd(Eigen::Matrix3d(state[hinge.lower].R.transpose() * state[hinge.upper].R))
        .angle();
  };
  double most = 0;  // rad
  for (const model::State& state : sheet.path) most = std::max(most, turn_in(state));
  EXPECT_GT(most, turn_in(sheet.path.back()) + 0.05);
  EXPECT_NEAR(std::abs(sheet.hinges[0].turn), most, 1e-9);
}

/// Of a twist unit, whose bodies rock, the upper and lower edges of blocks are pulled further apart than their middles.
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
      const model::MadeHinge& made = sheet.hinges[h].made;
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
  // 70 degrees times half the thickness over the gap
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("is strained by 0.611 on the way to the fold; its material bears 0.5"));
  ASSERT_EQ(exported(scratch, panel_with("1.2"), "--format stl").code, 0);
  EXPECT_EQ(text_of(scratch / "out/print.txt").find("strained"), std::string::npos);
}

/// Who has blocks that do not fit is not told to take blocks.
TEST(Export, AdvisesNoOtherHingesWhereTheDesignSaysWhichItHas) {
  const std::string design = R"(kinetix: 1
structure: {cells: [3, 3], cell_mm: 20, wall_mm: {thickness: 6, height: 8}}
design: {theta_deg: 70, hinges: [{wall: [[1, 1], [2, 1]], t: 0.42, alpha_deg: 80}]}
hinge: {kind: block, material: tango, gap_mm: 6, thickness_mm: 1}
)";
  const Scratch scratch;
  const Outcome run = exported(scratch, design, "--format stl");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("run into each other"));
  EXPECT_EQ(run.err.find("--hinge block"), std::string::npos) << run.err;
}

TEST(Export, RefusesThetaAtWhichKnucklesMeet) {
  const std::string design =
      std::string(panel).replace(std::string(panel).find("theta_deg: 20"), 13, "theta_deg: 38");
  expect_refused(design, "--format stl --hinge pin", "run into each other at theta");
}

/// Opposite knuckles come to L (cos theta - sin theta) of each other, less their width: here to the clearance but for what
/// polygons may take of it.
TEST(Export, SaysFromWhichThetaOnSolidsAreTooNear) {
  const Scratch scratch;
  const std::string design =
      std::string(panel).replace(std::string(panel).find("theta_deg: 20"), 13, "theta_deg: 38");
  const Outcome run = exported(scratch, design, "--format stl --hinge pin");
  std::smatch from;
  ASSERT_TRUE(std::regex_search(
      run.err, from, std::regex(R"(come nearer to each other than 0.05 mm from theta ([0-9.]+) deg on)")))
      << run.err;
  const double knuckle = 1 + 2 * (0.05 + 0.6), asked = 0.05 - 0.01, share = (knuckle + asked) / 12;
  const double closed_form = 180 / M_PI * std::acos(share / std::sqrt(2)) - 45;
  EXPECT_NEAR(std::stod(from[1]), closed_form, 0.25) << "0.02 mm of polygons, 0.1 degrees of rounding";
}

/// One block in the middle of pins: they are still held to their clearance.
TEST(Export, HoldsPinsBesideABlockToTheirOwnClearance) {
  std::string design = panel;
  design.replace(
      design.find("{theta_deg: 20}"), 15,
      "{theta_deg: 38, hinges: [{wall: [[0, 0], [1, 0]], hinge: {kind: block, material: tango, gap_mm: "
      "3, thickness_mm: 0.8, height_mm: 6}}]}");
  expect_refused(design, "--format stl --hinge pin", "come nearer to each other than 0.05 mm from theta");
  design.replace(design.find("38"), 2, "20");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge pin").code, 0);
  const Json json = said_of(scratch);
  EXPECT_EQ(json["path"]["in_hinges"]["asked_mm"], 0.05);
  EXPECT_EQ(json["path"]["elsewhere"]["asked_mm"], 0.05);
  EXPECT_TRUE(json["swelling_mm"].is_null()) << "its parts are joined";
}

/// Films in the creases of a sheet of blocks.
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
  EXPECT_THAT(words, HasSubstr("1 films of pp: gap 2 mm, thickness 0.4 mm"));
  EXPECT_THAT(words, HasSubstr("films of pp and blocks of tango are one soft part in the files"));
  EXPECT_THAT(words, HasSubstr("polyjet prints soft parts of tango"));
}

/// What is said of one hinge is of those that most are, wherever the others stand.
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
  const Json said = said_of(mixed);
  EXPECT_EQ(said["hinge"], "pin");
  EXPECT_EQ(said["clearance_mm"], 0.1);
  EXPECT_EQ(said["k"], said_of(pins)["k"]);
}

TEST(Export, SaysThatSlsPrintsFilmsOfItsOwnMaterial) {
  std::string design = panel;
  design.replace(design.find("{theta_deg: 20}"), 15,
                 "{theta_deg: 10}\nhinge: {kind: film, material: pp, gap_mm: 2.5, thickness_mm: 0.5}");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --process sls").code, 0);
  EXPECT_THAT(said_of(scratch)["warnings"].dump(), HasSubstr("sls prints walls and films in one, of pa12"));
}

/// A block so long that it crosses the wall of another body, once its own two have turned away from it.
TEST(PathClearance, CountsBlocks) {
  const Scratch scratch;
  app::PreparedPrint print =
      app::prepared(app::read_design(scratch.write("panel.yaml", panel)), *model::find_process("polyjet"),
                    {.kind = model::HingeKind::block}, false);
  app::PrintSheet& sheet = print.job.sheet;
  ASSERT_TRUE(is_kept(print.clearance));
  ASSERT_TRUE(is_kept(path_clearance(sheet))) << "as it was";
  for (Eigen::Vector3d& p : sheet.soft[0].points) p.x() += p.x() > 6 ? 12 : 0;
  const app::PathClearance wrong = path_clearance(sheet);
  EXPECT_FALSE(is_kept(wrong));
  EXPECT_EQ(wrong.first_too_near->theta, 0);
  EXPECT_THAT(part_name(sheet, std::max(wrong.least().first, wrong.least().second)),
              HasSubstr("soft part of "));
}

TEST(Export, SaysHowFarPartsMaySwell) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --process sla").code, 0);
  EXPECT_NEAR(said_of(scratch)["swelling_mm"], 0.25 / 2, 1e-9) << "rods and bores, and eyes between forks";
}

TEST(Export, RefusesAFolderThatCannotBeWritten) {
  const Scratch scratch;
  const std::string file = scratch.write("file", "");
  const Outcome run = kinetix_opt("export " + scratch.write("panel.yaml", panel) +
                                  " --format stl --quiet -o " + file + "/out");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST(Schema, OfPrintsRefusesWhatIsMissingOrOutOfRange) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl").code, 0);
  const Json json = said_of(scratch);
  for (const auto& [key, value] : json.items()) {
    Json less = json;
    less.erase(key);
    EXPECT_NE(schema_errors(less, "print"), "") << key;
  }
  for (const char* change :
       {R"({"bodies": -1})", R"({"process": "magic"})", R"({"volume_mm3": {"hard": 0, "soft": 0}})",
        R"({"tiles": [1]})", R"({"overhang_mm2": {"flat": 1}})", R"({"slicer": {"speed": 1}})"}) {
    Json bad = json;
    bad.update(Json::parse(change));
    EXPECT_NE(schema_errors(bad, "print"), "") << change;
  }
}

/// The sheets' volume in plastic, to within what skirts and rounding of lines to whole widths come to.
TEST(Slicer, TellsTimeAndAsMuchMaterialAsThereIsVolume) {
  for (const char* process : {"fdm", "sla"}) {
    const Scratch scratch;
    ASSERT_EQ(
        exported(scratch, panel, std::string("--format stl --hinge block --slice --process ") + process).code,
        0);
    const Json json = said_of(scratch);
    ASSERT_TRUE(json["slicer"].contains("seconds")) << json["slicer"];
    const double own = double(json["volume_mm3"]["hard"]) + double(json["volume_mm3"]["soft"]);
    EXPECT_NEAR(double(json["slicer"]["material_mm3"]) / own, 1, 0.15) << process;
    EXPECT_GT(json["slicer"]["seconds"], 60);
    EXPECT_EQ(json["slicer"]["prints"], std::string(process) == "sla" ? 2 : 1);
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("of material"));
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr(", without supports, by PrusaSlicer"));
  }
}

/// The report beside the design learns it, if it is of the same sheet.
TEST(Slicer, IsQuotedByTheReportOfTheSameSheet) {
  const Scratch scratch;
  const std::string folder = scratch / "result", page = folder + "/report.html",
                    design = folder + "/design.yaml";
  ASSERT_EQ(kinetix_opt("simulate " + scratch.write("panel.yaml", panel) + " -o " + folder).code, 0);
  const std::string print = "export " + folder + " --format stl --hinge block --slice --process sla -o " +
                            std::string(scratch / "print");
  const Outcome run = kinetix_opt(print);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("report       " + page));
  const Json told = Json::parse(app::data_of_report(text_of(page)))["print"],
             slicer = Json::parse(text_of(scratch / "print/print.json"))["slicer"];
  EXPECT_EQ(told["process"], "sla");
  EXPECT_EQ(told["hinges"], "block");
  for (const char* key : {"seconds", "material_mm3", "prints"}) EXPECT_EQ(told[key], slicer[key]) << key;

  const std::string before = text_of(page);
  const Outcome larger = kinetix_opt(print + " --cell-mm 15");
  ASSERT_EQ(larger.code, 0) << larger.err;
  EXPECT_EQ(text_of(page), before) << "of cells of another size";
  EXPECT_EQ(larger.out.find("report       "), std::string::npos) << larger.out;
  ASSERT_EQ(kinetix_opt(print + " --state folded").code, 0);
  EXPECT_EQ(text_of(page), before) << "of the sheet that stands folded in the printer";
  std::string other = panel;
  other.replace(other.find("cell_mm: 12"), 11, "cell_mm: 13");
  std::ofstream(design) << other;
  ASSERT_EQ(kinetix_opt(print).code, 0);
  EXPECT_EQ(text_of(page), before);
}

TEST(Slicer, ThatIsNotThereIsSaidInWords) {
  const Scratch scratch;
  const app::PreparedPrint print = app::prepared(app::read_design(scratch.write("panel.yaml", panel)),
                                                 *model::find_process("sla"), {}, false);
  const app::SlicerAnswer answer = app::ask_slicer(print.job, "no-such-slicer");
  EXPECT_FALSE(answer.estimate);
  EXPECT_EQ(answer.why_none, "no slicer found: no-such-slicer is not on PATH");
  EXPECT_THAT(app::ask_slicer(print.job, "false").why_none, HasSubstr("gave up"));
}

TEST(Slicer, WithoutAProcessThatItKnowsIsNotAsked) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --slice").code, 0);
  EXPECT_EQ(said_of(scratch)["slicer"]["why_none"], "no slicer found for polyjet");
}

TEST(Slicer, TimesAreReadInDaysHoursMinutesAndSeconds) {
  EXPECT_EQ(app::seconds_of("17m 40s"), 17 * 60 + 40);
  EXPECT_EQ(app::seconds_of("1d 2h 3m 4s"), 86400 + 2 * 3600 + 3 * 60 + 4);
  EXPECT_TRUE(std::isnan(app::seconds_of("soon")));
}

/// A square frustum on its wide, then on its narrow end: its four slanting faces hang over, or none.
TEST(Overhang, IsThatOfAFrustumByHand) {
  model::Polyhedron frustum;
  for (const double half : {1.0, 0.5})
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      frustum.points.emplace_back(half * x, half * y, half == 1 ? 0 : 0.25);
  frustum.add_face({3, 2, 1, 0});
  frustum.add_face({4, 5, 6, 7});
  for (int k = 0; k < 4; ++k) frustum.add_face({k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  const Eigen::Matrix3d flat = Eigen::Matrix3d::Identity(), over = Eigen::Vector3d(1, -1, -1).asDiagonal();
  EXPECT_EQ(app::overhang_mm2(frustum, flat), 0);
  const double slant = std::hypot(0.5, 0.25);
  EXPECT_NEAR(app::overhang_mm2(frustum, over), 4 * 1.5 * slant, 1e-12);
}

TEST(Orientation, OfASheetThatIsLaidOnItsFaceIsThatOfItsFiles) {
  const Scratch flat, over;
  const std::string leaning = std::string(panel).replace(
      std::string(panel).find("theta_deg: 20"), 13,
      "theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 20}, {wall: [[0, 1], "
      "[1, 1]], beta_deg: -20}, {wall: [[0, 2], [1, 2]], beta_deg: 20}]");
  ASSERT_EQ(exported(flat, leaning, "--format stl --hinge block").code, 0);
  ASSERT_EQ(exported(over, leaning, "--format stl --hinge block --orient over").code, 0);
  const Json one = said_of(flat), other = said_of(over);
  EXPECT_EQ(one["orientation"], "flat");
  EXPECT_EQ(other["orientation"], "over");
  EXPECT_EQ(one["overhang_mm2"], other["overhang_mm2"]) << "of the same sheet";
  EXPECT_NEAR(volume_of_stl(text_of(over / "out/all.stl")) / volume_of_stl(text_of(flat / "out/all.stl")), 1,
              1e-6);
  EXPECT_NE(text_of(over / "out/all.stl"), text_of(flat / "out/all.stl"));
}

/// Formats that no printer reads have the sheet in its own place, as their motion has it.
TEST(Orientation, LeavesTheSceneWhereItsMotionIs) {
  const Scratch flat, over;
  ASSERT_EQ(exported(flat, panel, "--format glb --hinge block").code, 0);
  ASSERT_EQ(exported(over, panel, "--format glb --hinge block --orient over").code, 0);
  EXPECT_EQ(text_of(over / "out/panel.glb"), text_of(flat / "out/panel.glb"));
}

TEST(Orientation, ThatIsProposedHasTheLeastOverhang) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --orient best").code, 0);
  const Json json = said_of(scratch);
  const double here = json["overhang_mm2"][std::string(json["orientation"])];
  for (const auto& [way, area] : json["overhang_mm2"].items()) EXPECT_GE(double(area), here) << way;
  ASSERT_EQ(json["orientation"], "flat") << "both sides of upright pins are alike";
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("flat on the bed, as it is in the files"));
  expect_refused(panel, "--format stl --orient upp", "unknown orient `upp`");
}

/// A block of 20 x 2 x 10 mm with text on its front.
TEST(RaisedText, KeepsTheSolidClosedAndAddsItsSquares) {
  model::Polyhedron block;
  for (const double z : {0.0, 10.0})
    for (const auto& [x, y] : {std::pair{0, 0}, {20, 0}, {20, 2}, {0, 2}}) block.points.emplace_back(x, y, z);
  block.add_face({3, 2, 1, 0});
  block.add_face({4, 5, 6, 7});
  for (int k = 0; k < 4; ++k) block.add_face({k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  const app::TextFace face{{9.5, 0, 5}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), 0.7, 0.4};
  for (const char* text : {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "7", "89."}) {
    model::Polyhedron with = block;
    app::raise_text(text, face, with);
    EXPECT_TRUE(is_closed(with)) << text;
    EXPECT_NEAR(volume_mm3(with) - volume_mm3(block), app::raised_squares(text) * 0.7 * 0.7 * 0.4, 1e-9)
        << text;
  }
  EXPECT_EQ(app::raised_squares("0.1"), 12 + 1 + 5);
  EXPECT_THROW(app::raise_text("a", face, block), std::invalid_argument);
  EXPECT_THROW(app::raise_text("0123456789", face, block), std::invalid_argument) << "wider than the block";
  app::TextFace nowhere = face;
  nowhere.middle.y() = -1;
  EXPECT_THROW(app::raise_text("1", nowhere, block), std::invalid_argument);
  EXPECT_TRUE(is_closed(block)) << "as it was";
}

/// Opposite knuckles of a basic cell come to L (cos theta - sin theta) of each other, less their own width.
TEST(PathClearance, IsThatOfTheClosedFormInABasicPanel) {
  const Scratch scratch;
  const app::PreparedPrint print = app::prepared(app::read_design(scratch.write("panel.yaml", panel)),
                                                 *model::find_process("sla"), {}, false);
  const double theta = 20 * M_PI / 180, knuckle = 1 + 2 * (0.25 + 0.8),
               tolerance = 0.02;  // polygons for circles
  EXPECT_NEAR(print.clearance.elsewhere.mm, 12 * (std::cos(theta) - std::sin(theta)) - knuckle, tolerance);
  EXPECT_NEAR(print.clearance.elsewhere.theta, theta, 1e-12);
  EXPECT_NEAR(print.clearance.in_hinges.mm, 0.25, 1e-9);
}

}  // namespace
}  // namespace kinetix::testing
