#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/print/format/print_format.hpp"
#include "app/print/format/zip_text.hpp"
#include "app/print/slicer.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

TEST(Export, WritesTheSameBytesAgain) {
  const Scratch scratch;
  const std::string small = std::string(panel).replace(std::string(panel).find("[3, 2]"), 6, "[2, 1]");
  std::vector<std::string> bytes[2];
  for (auto& files : bytes) {
    const Outcome run = exported(scratch, small, "--format all --process sla");
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

/// Formats and beds are lists with commas, so the next argument is the design.
TEST(Export, TakesADesignBehindItsOptions) {
  const Scratch scratch;
  const std::string design = scratch.write("panel.yaml", panel), out = " -o " + std::string(scratch / "out");
  for (const char* options : {"--format stl,svg ", "--format stl --format svg --bed 300,200 "}) {
    const Outcome run = kinetix_opt("export" + out + " " + options + design);
    ASSERT_EQ(run.code, 0) << options << run.err;
    EXPECT_FALSE(text_of(scratch / "out/panel.svg").empty());
  }
  const Outcome bed = kinetix_opt("export" + out + " --format stl --bed 300,200 " + design);
  EXPECT_EQ(bed.code, 0) << bed.err;
}

TEST(Export, SaysTheVolumesOfItsFiles) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge block").code, 0);
  const Json json = print_json_of(scratch);
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

/// The radius is the slicer's default, or smaller if the default would close the pins.
TEST(Export, NamesTheSettingsThatKeepGapsOpen) {
  for (const auto& [process, radius_mm, foot_mm] :
       {std::tuple{"polyjet", 0.4 * 0.05, 0.0}, {"sla", 0.049, 0.2}}) {
    const Scratch scratch;
    const std::string choice = std::string("--hinge pin --process ") + process;
    ASSERT_EQ(exported(scratch, panel, "--format 3mf " + choice).code, 0);
    const Json said = print_json_of(scratch)["gap_settings"];
    EXPECT_NEAR(said["closing_radius_mm"], radius_mm, 1e-12);
    EXPECT_EQ(said["elephant_foot_compensation_mm"], foot_mm);
    EXPECT_EQ(said["xy_compensation_mm"], 0);
    const std::string text = text_of(scratch / "out/print.txt");
    EXPECT_THAT(text, HasSubstr(fmt::format("gap closing radius {:g} mm", radius_mm)));
    EXPECT_THAT(text, HasSubstr(fmt::format("elephant foot compensation {:g} mm", foot_mm)));
    const std::string config = app::text_in_zip(scratch / "out/panel.3mf", "Metadata/Slic3r_PE_model.config");
    EXPECT_THAT(config, HasSubstr(fmt::format("key=\"slice_closing_radius\" value=\"{:g}\"", radius_mm)));
  }
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format 3mf --hinge block").code, 0);
  EXPECT_TRUE(print_json_of(scratch)["gap_settings"].is_null());
}

TEST(Export, RefusesOptionsThatAreNoNumbersInOneLine) {
  for (const char* option : {"--cell-mm nan", "--clearance nan", "--bed nan,100", "--clearance 0.001",
                             "--cell-mm x", "--state half", "--bed 5"})
    expect_refused(panel, std::string("--format stl ") + option, "(see --help)");
}

TEST(Export, SaysWhichOptionsChangeNothing) {
  const Scratch scratch;
  const std::string described =
      std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.2}\n";
  ASSERT_EQ(exported(scratch, described, "--format stl --hinge block").code, 0);
  EXPECT_EQ(print_json_of(scratch)["hinge"], "pin");
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), HasSubstr("--hinge has no effect: the design sets"));
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge block --clearance 0.2 --loose-rods").code, 0);
  const std::string said = print_json_of(scratch)["warnings"].dump();
  EXPECT_THAT(said, HasSubstr("--clearance has no effect: no hinge is a pin"));
  EXPECT_THAT(said, HasSubstr("--loose-rods has no effect: no hinge is a pin"));
  ASSERT_EQ(exported(scratch, panel, "--format stl --caps").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(),
              HasSubstr("--round-caps has no effect: all axes are in the middle"));
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --clearance 0.2 --loose-rods").code, 0);
  EXPECT_EQ(print_json_of(scratch)["warnings"].dump().find("has no effect"), std::string::npos);
}

TEST(Export, SaysThatOtherCellsMakeTheSheetLargerOrSmaller) {
  const Scratch scratch;
  for (const auto& [edge_mm, words] :
       {std::pair{"30",
                  "made with cells of 30 mm instead of 12: flat and folded sheet are 2.5 times as large. "
                  "For the size of the goal search again with fewer cells"},
        {"9", "are 0.75 times as large. For the size of the goal search again with more cells"}}) {
    ASSERT_EQ(exported(scratch, panel, std::string("--format stl --hinge block --cell-mm ") + edge_mm).code,
              0);
    EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), HasSubstr(words));
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr(words));
  }
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge block --cell-mm 12").code, 0);
  EXPECT_EQ(print_json_of(scratch)["warnings"].dump().find("times as large"), std::string::npos);
}

TEST(Export, SaysThatDrawingsAreAlwaysFlat) {
  const Scratch scratch;
  const std::string folded = "--hinge block --state folded --format ";
  ASSERT_EQ(exported(scratch, panel, folded + "svg,dxf,stl").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(),
              HasSubstr("--state folded has no effect in svg and dxf, where the sheet is always flat"));
  ASSERT_EQ(exported(scratch, panel, folded + "mjcf").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(),
              HasSubstr("--state folded has no effect in mjcf, where the sheet is always flat"));
  ASSERT_EQ(exported(scratch, panel, folded + "stl").code, 0);
  EXPECT_EQ(print_json_of(scratch)["warnings"].dump().find("has no effect"), std::string::npos);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("orientation  folded, as its motion leaves it"));
}

/// Support depends on the overhang in the sheet's orientation, and on support material that the process adds itself.
TEST(Export, AsksForSupportsWhereTheProcessNeedsThem) {
  for (const auto& [options, words] :
       {std::pair{"--process fdm --hinge block", "supports     none\n"},
        {"--process fdm --hinge pin --cell-mm 30",
         "supports     none: the {:.1f} mm2 between the knuckles of pins bridge their gaps"},
        {"--process sla --hinge pin",
         "supports     none: the {:.1f} mm2 between the knuckles of pins bridge their gaps"},
        {"--process polyjet --hinge pin",
         "none to plan: support material that the printer lays down by itself "
         "carries the {:.1f} mm2"},
        {"--process sls --hinge pin --cell-mm 30", "none to plan: the powder carries the {:.1f} mm2"}}) {
    const Scratch scratch;
    ASSERT_EQ(exported(scratch, panel, std::string("--format stl ") + options).code, 0);
    const double hangs = print_json_of(scratch)["overhang_mm2"]["flat"];
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr(fmt::format(fmt::runtime(words), hangs)))
        << options;
  }
}

TEST(Export, MakesADesignForItsOwnProcess) {
  const Scratch scratch;
  const std::string design = std::string(panel) + "process: sla\n";
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge pin").code, 0);
  EXPECT_EQ(print_json_of(scratch)["process"], "sla");
  ASSERT_EQ(exported(scratch, design, "--format stl --hinge pin --process polyjet").code, 0);
  EXPECT_EQ(print_json_of(scratch)["process"], "polyjet");
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
  EXPECT_THAT(refused.err, HasSubstr("this folder has no design.yaml"));
}

TEST(Export, KeepsToTheLimitsOfOnesOwnPrinter) {
  const std::string design = std::string(panel) + "process: {clearance_mm: 0.2}\n";
  for (const char* options : {"--format stl --hinge pin", "--format stl --hinge pin --process polyjet"}) {
    const Scratch scratch;
    ASSERT_EQ(exported(scratch, design, options).code, 0);
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("clearance 0.2 mm per side")) << options;
  }
  expect_refused(std::string(panel) + "process: {base: fdm, least_wall_mm: 0.9}\n", "--format stl",
                 "a wall of 0.8 mm is below the minimum of fdm, 0.9 mm", not_printable);
}

TEST(Export, SaysHowFarPartsMaySwell) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --process sla").code, 0);
  EXPECT_NEAR(print_json_of(scratch)["swelling_mm"], 0.25 / 2, 1e-9)
      << "rods and bores, and eyes between forks";
}

/// Rounding can give a pin the least margin over its clearance although another pin fuses first.
TEST(Export, SaysWhatTheNarrowestPinLeaves) {
  std::string design = panel;
  design.replace(design.find("{theta_deg: 20}"), 15,
                 "{theta_deg: 10, hinges: [{wall: [[0, 0], [1, 0]], hinge: {kind: pin, diameter_mm: 1, "
                 "clearance_mm: 0.4}}]}\nhinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.1}");
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, design, "--format stl --cell-mm 20").code, 0);
  EXPECT_NEAR(print_json_of(scratch)["swelling_mm"], 0.1 / 2, 0.005)
      << "polygons leave their circles by 0.01 mm";
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("motion       solids stay 0.1"));
  const Outcome coupon = kinetix_opt("export --coupon -o " + std::string(scratch / "coupon"));
  ASSERT_EQ(coupon.code, 0) << coupon.err;
  EXPECT_NEAR(Json::parse(text_of(scratch / "coupon/print.json"))["swelling_mm"], 0.1 / 2, 0.005);
}

/// Tiles do not help, since they do not reduce the height.
TEST(Export, SaysWhereThePrintIsHigherThanUsualPrinters) {
  const std::string words = " mm high: a usual fdm printer prints 250 mm at most";
  for (const auto& [height, is_reported] : {std::pair("251", true), {"249", false}}) {
    const std::string design = fmt::format(
        "kinetix: 1\nstructure: {{cells: [2, 1], cell_mm: 40, wall_mm: {{thickness: 2, height: "
        "{}}}}}\ndesign: {{theta_deg: 10}}\n",
        height);
    const Scratch scratch;
    ASSERT_EQ(exported(scratch, design, "--format stl --process fdm --hinge block").code, 0);
    EXPECT_EQ(print_json_of(scratch)["warnings"].dump().find(words) != std::string::npos, is_reported)
        << height;
  }
}

/// The flat sheet of 24 columns is 12 * 24 mm long. The folded sheet fits on the bed, so tiles would not help.
TEST(Export, AdvisesNoTilesOfTheFold) {
  std::string design = panel;
  design.replace(design.find("[3, 2]"), 6, "[24, 1]");
  const std::string words = "larger than the bed of a usual fdm printer, 220 x 220 mm",
                    advice = "to cut it into tiles";
  for (const auto& [state, is_advised] : {std::pair("flat", true), {"folded", false}}) {
    const Scratch scratch;
    ASSERT_EQ(
        exported(scratch, design, std::string("--format stl --process fdm --hinge block --state ") + state)
            .code,
        0);
    const std::string notes = print_json_of(scratch)["warnings"].dump();
    EXPECT_THAT(notes, HasSubstr(words)) << state;
    EXPECT_EQ(notes.find(advice) != std::string::npos, is_advised) << state;
  }
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
  const Json json = print_json_of(scratch);
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

}  // namespace
}  // namespace kinetix::testing
