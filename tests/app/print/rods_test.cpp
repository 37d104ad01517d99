#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/print/fit.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "model/material/process.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/program.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Returns the cell edge, mm, from which on a process prints the panel with this kind of hinges.
double printable_edge_mm(const char* process, model::HingeKind kind) {
  const Scratch scratch;
  app::Design design = app::read_design(scratch.write("panel.yaml", panel));
  design.structure.squares()->size.edge_mm = 2;
  design.process = *model::find_process(process);
  design.hinge.kind = kind;
  const auto size = find_printable_size(design);
  return size ? size->edge_mm : 0;
}

/// FDM does not print rods of 1 mm: there is a cut list, and no file of rods.
TEST(Rods, ThatTheProcessCannotPrintAreCutFromWire) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl,3mf --process fdm --hinge rod").code, 0);
  const Json json = print_json_of(scratch);
  EXPECT_EQ(json["hinge"], "rod");
  EXPECT_EQ(json["hinges"], 17);
  EXPECT_EQ(json["loose_rods"], 17);
  EXPECT_EQ(json["rods"], Json::parse(R"([{"count": 17, "diameter_mm": 1, "length_mm": 6,
                                           "material": "steel", "printable": false}])"));
  EXPECT_EQ(json["clearance_mm"], 0.2) << "two deviations of the process";
  EXPECT_FALSE(fs::exists(scratch / "out/rods.stl"));
  EXPECT_FALSE(fs::exists(scratch / "out/panel_rods.3mf"));
  const std::string cut = "17 rods of 1 mm, each 6 mm long, 102 mm of steel in all. Cut them from wire.";
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              AllOf(HasSubstr(cut), HasSubstr("rods of steel: 1 x 6 mm, clearance 0.2 mm per side")));
  EXPECT_THAT(text_of(scratch / "out/card.html"), HasSubstr(cut + " Push them in after printing"));
}

/// An earlier export's file of rods does not stay.
TEST(Rods, ThatTheProcessPrintsAreInAFile) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --process polyjet --hinge rod").code, 0);
  EXPECT_EQ(print_json_of(scratch)["rods"][0]["printable"], true);
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("Cut them from wire, or print the file of rods. Push them in"));
  const double rods = volume_of_stl(text_of(scratch / "out/rods.stl"));
  EXPECT_NEAR(rods, 17 * M_PI / 4 * 6, 0.02 * 17 * M_PI / 4 * 6) << "17 rods of 1 x 6 mm, as polygons";
  ASSERT_EQ(exported(scratch, panel, "--format stl --process fdm --hinge rod").code, 0);
  EXPECT_FALSE(fs::exists(scratch / "out/rods.stl"));
}

/// Nothing is printed in the bore of a rod: it may be narrower than the gaps between bodies, which keep the process's
/// clearance.
TEST(Rods, MayHaveNarrowerBoresThanTheProcessPrintsGaps) {
  const auto with = [](const char* clearance) {
    return std::string(panel) + "hinge: {kind: rod, diameter_mm: 1.5, clearance_mm: " + clearance + "}\n";
  };
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, with("0.1"), "--format stl --process fdm").code, 0);
  const Json json = print_json_of(scratch);
  EXPECT_EQ(json["rods"][0]["diameter_mm"], 1.5);
  EXPECT_EQ(json["clearance_mm"], 0.1);
  EXPECT_EQ(json["path"]["elsewhere"]["asked_mm"], 0.3);
  EXPECT_GE(double(json["path"]["elsewhere"]["mm"]), 0.295);
  expect_refused(with("0.05"), "--format stl --process fdm",
                 "a rod's clearance of 0.05 mm is below the minimum of fdm, 0.1 mm", not_printable);
}

TEST(Rods, NeedSmallerCellsThanPrintedPins) {
  const double pins_mm = printable_edge_mm("fdm", model::HingeKind::pin),
               rods_mm = printable_edge_mm("fdm", model::HingeKind::rod);
  EXPECT_GT(rods_mm, 0);
  EXPECT_LT(rods_mm, 0.75 * pins_mm) << pins_mm;
  EXPECT_LE(rods_mm, printable_edge_mm("sls", model::HingeKind::pin));
}

TEST(Rods, TakeCapsAndAreAlwaysSeparate) {
  const Scratch scratch;
  const std::string open = std::string(panel) + "hinge: {kind: rod}\n";
  ASSERT_EQ(exported(scratch, open, "--format stl --process fdm --cell-mm 16 --caps").code, 0);
  EXPECT_EQ(print_json_of(scratch)["hinge"], "rod");
  ASSERT_EQ(exported(scratch, open, "--format stl --process fdm --loose-rods").code, 0);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("--loose-rods has no effect: no hinge is a pin"));
}

/// A search of `--hinge rod` ends with rods of their usual size, in cells that `export` prints.
TEST(Rods, AreWhatASearchMakesIfTheyAreAskedFor) {
  const Scratch scratch;
  const std::string folder = scratch / "rib";
  const Outcome run = kinetix_opt(std::string(KINETIX_SOURCE "/targets/shapes/helmet_rib.yaml") +
                                  " --process fdm --hinge rod --no-verify --quiet -o " + folder);
  ASSERT_EQ(run.code, 0) << run.err;
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result, "result"), "");
  EXPECT_EQ(result["manufacture"]["hinge"]["kind"], "rod");
  EXPECT_EQ(result["manufacture"]["hinge"]["material"], "steel");
  EXPECT_EQ(result["verdict"]["printable"], true);
  EXPECT_THAT(
      text_of(folder + "/design.yaml"),
      HasSubstr("hinge: {model: rotary, kind: rod, material: steel, diameter_mm: 1, clearance_mm: 0.2"));
  const Outcome print = kinetix_opt("export " + folder + " --format stl -o " + folder + "/print");
  EXPECT_EQ(print.code, 0) << print.err;
  EXPECT_THAT(text_of(folder + "/print/print.txt"), HasSubstr("mm of steel in all. Cut them from wire."));
}

}  // namespace
}  // namespace kinetix::testing
