#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/goals/display/display_file.hpp"
#include "app/pipeline/pipeline.hpp"
#include "targets/document/document.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/bad_input.hpp"

/// Tests the drives of a display: plates that grip or press, or a hinge.
namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// An L on a small panel.
const std::string corner = R"(kinetix: 1
target: {kind: display, rows: ["00000000", "00100000", "00100000", "00100000", "00100000", "00111100", "00000000"]}
tolerance: {contrast: 1}
)";

TEST(DisplayDrive, OfAHingeLeavesRowsFree) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(
      scratch.write("corner.yaml", corner + "drive: {kind: hinge, angle_deg: 60}\n") + " -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("N mm at hinge angle"));
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  const Json& display = result["display"];
  EXPECT_FALSE(display.contains("compression") || display.contains("axis"));
  EXPECT_NEAR(std::abs(display["angle_rad"].get<double>()), 60 * radians_per_degree, 1e-12);
  EXPECT_NEAR(display["scaled"]["theta_rad"].get<double>(), 30 * radians_per_degree, 1e-12);
  EXPECT_GE(result["metrics"]["auc_physics"], 0.97);
  EXPECT_LE(result["metrics"]["verify_rms"], 1e-5);
  EXPECT_NE(result["metrics"]["load_Nmm"], 0);

  const Outcome again = kinetix_opt("verify " + folder + "/design.yaml -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
}

TEST(DisplayDrive, OfAHingeTurnsTheWallThatTheFileNames) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run =
      kinetix_opt(scratch.write("corner.yaml", corner + "drive: {kind: hinge, wall: [[0, 1], [0, 2]]}\n") +
                  " --no-verify -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(text_of(folder + "/design.yaml"), HasSubstr("drive: {kind: hinge, wall: [[0, 1], [0, 2]]"));
}

TEST(DisplayDrive, OfPlatesThatPressAgreesWithTheModel) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run =
      kinetix_opt(scratch.write("corner.yaml", corner + "drive: {press: true}\n") + " -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("push-only plates: "));
  EXPECT_THAT(text_of(folder + "/design.yaml"), HasSubstr(", press: true}"));
  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_GE(result["metrics"]["auc_physics"], 0.97);
  EXPECT_LE(result["metrics"]["verify_rms"], 1e-6);
  const Outcome again = kinetix_opt("verify " + folder + "/design.yaml -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
}

TEST(DisplayDrive, RefusesWhatDoesNotGoTogether) {
  const BadInput cases[] = {
      {corner + "drive: {kind: hand}\n", 4, 15, "drive.kind", {"plates, hinge"}},
      {corner + "drive: {angle_deg: 60}\n", 4, 9, "drive.angle_deg", {}},
      {corner + "drive: {kind: hinge, axis: x}\n", 4, 22, "drive.axis", {}},
      {corner + "drive: {kind: hinge, press: true}\n", 4, 22, "drive.press", {}},
      {corner + "drive: {kind: hinge, angle_deg: 0}\n", 4, 33, "drive.angle_deg", {"above 0", "120"}},
      {corner + "drive: {kind: hinge, angle_deg: 121}\n", 4, 33, "drive.angle_deg", {"at most 120"}},
      {corner + "drive: {kind: hinge, wall: [[0, 0], [0, 9]]}\n", 4, 28, "drive.wall", {"not neighbours"}},
      {corner + "drive: {kind: hinge, wall: [[20, 0], [20, 1]]}\n", 4, 28, "drive.wall", {"has no wall"}},
      {corner + "drive: {press: 3}\n", 4, 16, "drive.press", {"true"}},
      {corner + "drive: {kind: hinge}\nvariables: {axis: [x, y]}\n",
       5,
       13,
       "variables.axis",
       {"only applies to plates"}},
      {corner + "drive: {kind: hinge}\nvariables: {stretch_mm: 0.1}\n",
       5,
       13,
       "variables.stretch_mm",
       {"only applies to plates"}},
      {corner + "drive: {kind: hinge}\nvariables: {compression: {range: [0.1, 0.2]}}\n",
       5,
       13,
       "variables.compression",
       {"only applies to plates"}},
      {corner + "drive: {kind: hinge}\nvariables: {offset_mm: 0}\n", 4, 15, "drive.kind", {"needs plates"}},
  };
  for (const BadInput& bad : cases)
    expect_refused(bad, "bad.yaml",
                   [&] { app::read_display_file(targets::parse_document(bad.text, "bad.yaml")); });
}

TEST(DisplayDrive, PlatesThatPressTakeElasticHinges) {
  const Scratch scratch;
  const std::string text = R"(kinetix: 1
structure: {cells: [3, 3], cell_mm: 10}
design: {theta_deg: 20}
drive: {kind: plates, compression: 0.06, press: true}
)";
  const Outcome run =
      kinetix_opt("verify " + scratch.write("loose.yaml", text) + " -o " + scratch.path() + "/out");
  EXPECT_EQ(run.code, 2) << run.out;
  EXPECT_THAT(run.err, HasSubstr("loose.yaml: drive.press: true needs elastic hinges"));
}

}  // namespace
}  // namespace kinetix::testing
