#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/print/exports.hpp"
#include "tests/app/program.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Returns the size along x and y in print.json, rounded up to whole mm.
std::pair<int, int> whole_mm(const Json& json) {
  return {static_cast<int>(std::ceil(double(json["bounds_mm"][0]))),
          static_cast<int>(std::ceil(double(json["bounds_mm"][1])))};
}

TEST(Export, CutsALargeSheetIntoTilesThatTheBedHolds) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl,3mf --hinge pin --bed 28,30").code, 0);
  const Json json = print_json_of(scratch);
  EXPECT_EQ(json["tiles"], Json::array({2, 1}));
  EXPECT_EQ(json["loose_rods"], 3) << "between the two columns in the middle";
  double tiles = 0;
  for (const char* name : {"out/tile_1.stl", "out/tile_2.stl"}) {
    const std::string bytes = text_of(scratch / name);
    tiles += volume_of_stl(bytes);
    EXPECT_LE(width_of_stl(bytes), 28);
  }
  EXPECT_NEAR(tiles / double(json["volume_mm3"]["hard"]), 1, 1e-6) << "rods are a file of their own";
  EXPECT_NEAR(volume_of_stl(text_of(scratch / "out/rods.stl")), 3 * M_PI / 4 * 6, 0.02 * 3 * M_PI / 4 * 6);
  for (const char* name : {"out/panel_tile_2.3mf", "out/panel_rods.3mf"})
    EXPECT_TRUE(fs::exists(scratch / name));
  expect_refused(panel, "--format stl --bed 10,10", "a bed of 10 x 10 mm does not hold a body");
}

TEST(Export, SaysThatTilesOfAFoldedSheetAreFlat) {
  const Scratch scratch;
  const std::string options = "--format stl --hinge pin --bed 28,30";
  ASSERT_EQ(exported(scratch, panel, options).code, 0);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), Not(HasSubstr("--state folded")));
  const std::string flat = text_of(scratch / "out/tile_1.stl");
  ASSERT_EQ(exported(scratch, panel, options + " --state folded --orient over").code, 0);
  EXPECT_EQ(text_of(scratch / "out/tile_1.stl"), flat);
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("--state folded has no effect on tiles, which are printed flat"));
}

TEST(Export, LeavesASheetWholeThatTheBedHolds) {
  for (const char* hinge : {"pin", "block", "film"}) {
    const Scratch scratch;
    const std::string options = std::string("--format stl --hinge ") + hinge;
    ASSERT_EQ(exported(scratch, panel, options).code, 0);
    const auto [x, y] = whole_mm(print_json_of(scratch));
    for (const std::string& bed : {fmt::format("{},{}", x, y), fmt::format("{},{}", y, x)}) {
      ASSERT_EQ(exported(scratch, panel, options + " --bed " + bed).code, 0);
      EXPECT_EQ(print_json_of(scratch)["tiles"], Json::array({1, 1})) << hinge << " " << bed;
      EXPECT_FALSE(fs::exists(scratch / "out/tile_1.stl"));
    }
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("fits on the bed rotated by 90 degrees"));
    ASSERT_EQ(exported(scratch, panel, options + fmt::format(" --bed {},{}", x - 1, y)).code, 0);
    EXPECT_EQ(print_json_of(scratch)["tiles"], Json::array({2, 1})) << hinge;
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
  EXPECT_EQ(print_json_of(scratch)["tiles"], Json::array({4, 3})) << "a body each";
}

/// Optional files of an earlier sheet would be mistaken for parts of the new one.
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
  const Json json = print_json_of(scratch);
  double soft = 0;
  for (const char* name : {"out/tile_1_soft.stl", "out/tile_2_soft.stl"})
    soft += volume_of_stl(text_of(scratch / name));
  EXPECT_NEAR(soft / double(json["volume_mm3"]["soft"]), 1, 1e-6);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("2 x 1, one bed each: glue the soft parts"));
}

/// Pins in the lower walls and blocks in the upper walls: a cut through both needs rods and glue.
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

}  // namespace
}  // namespace kinetix::testing
