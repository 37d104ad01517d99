#include <gmock/gmock.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/base/geometry.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using Json = nlohmann::json;

TEST(SpaceCurveResult, IsAsTheSchemaHasIt) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(KINETIX_SOURCE "/targets/shapes/handle.yaml -o " + scratch.path());
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  const Json& curve = result["space_curve"];
  EXPECT_EQ(curve["goal_mm"].size(), result["target"]["points_mm"].size());
  EXPECT_NEAR(curve["physics"]["rms"], result["metrics"]["shape_rms_physics"], 1e-15);
  int bending = 0;
  for (const Json& column : curve["columns"]) bending += column.contains("turn_deg");
  EXPECT_EQ(bending, int(curve["columns"].size()) / 2);
  result["space_curve"]["columns"][0]["turn_deg"] = 1;
  EXPECT_NE(schema_errors(result), "") << "a column bends or shears";
}

/// Films bend towards flat, and the tilts compensate for it. The simulation with the same hinges reaches the same
/// state.
TEST(SpaceCurveResult, OfElasticHingesIsThatOfTheirEquilibrium) {
  const Scratch scratch;
  const std::string file = scratch.write(
      "goal.yaml",
      "kinetix: 1\ntarget: {kind: space_curve, points: [[0, 0, 0], [30, 0, 6], [60, 4, 8], [90, 12, 4], "
      "[120, "
      "20, 0]]}\n"
      "structure: {cells: [24, 1], cell_mm: 6}\nhinge: {kind: film, material: pp, gap_mm: 2, thickness_mm: "
      "0.3}\n"
      "drive: {kind: shape_memory, k_turn: 200}\n");
  const Outcome run = kinetix_opt(file + " -o " + std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  const Json result = Json::parse(text_of(scratch / "out/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  // Straight columns do not follow a curve exactly, even with rigid hinges. Tilts cannot compensate for that.
  const auto compensation = [&](const char* key) { return result["matter"][key].get<double>(); };
  EXPECT_LT(compensation("after_mm") - compensation("exact_mm"),
            0.5 * (compensation("before_mm") - compensation("exact_mm")));
  EXPECT_LE(result["metrics"]["shape_rms"], 0.01);
  EXPECT_NEAR(result["metrics"]["shape_rms_physics"], result["metrics"]["shape_rms"], 1e-6);

  // The result's turns are those of the displayed state, between the columns that shear. A column has two bodies.
  const Json& poses = result["states"][0]["poses"];
  const auto along = [&](std::size_t column, int axis) {
    double sum = 0;
    for (const std::size_t body : {0, 1})
      sum += poses[2 * column + 2 + body]["position_mm"][axis].get<double>() -
             poses[2 * column + body]["position_mm"][axis].get<double>();
    return sum;
  };
  const auto heading = [&](std::size_t column) { return std::atan2(along(column, 2), along(column, 0)); };
  const Json& columns = result["space_curve"]["columns"];
  for (std::size_t k = 1; k + 1 < columns.size(); k += 2)
    EXPECT_NEAR(columns[k]["turn_deg"], to_degrees(heading(k + 1) - heading(k - 1)), 0.05) << k;
}

/// Strips of given cells are longer than their first estimate. With less fold they would exceed the range that the file
/// allows.
TEST(SpaceCurveResult, OfGivenCellsKeepsToItsRanges) {
  const Scratch scratch;
  const auto hinges_of = [&](const std::string& curve, const std::string& cell_mm, const std::string& range) {
    const std::string file = scratch.write(
        "goal.yaml",
        "kinetix: 1\ntarget: {kind: space_curve, points: " + std::string(KINETIX_SOURCE "/targets/shapes/") +
            curve + ".csv}\nstructure: {cells: [40, 1], cell_mm: " + cell_mm + "}\nvariables: {" + range +
            "}\ntolerance: {shape: 0.05}\n");
    const Outcome run = kinetix_opt(file + " --no-verify -o " + std::string(scratch / "out"));
    EXPECT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
    return Json::parse(text_of(scratch / "out/result.json"))["structure"]["hinges"];
  };
  for (const Json& hinge : hinges_of("trefoil_arc", "13.132", "beta: {range_deg: [-25, 25]}"))
    EXPECT_LE(std::abs(hinge["beta_rad"].get<double>()), 25 * radians_per_degree + 1e-9);
  for (const Json& hinge : hinges_of("handle", "5.4732", "t: {range: [0.35, 0.65]}")) {
    EXPECT_GE(hinge["t"], 0.35 - 1e-9);
    EXPECT_LE(hinge["t"], 0.65 + 1e-9);
  }
}

}  // namespace
}  // namespace kinetix::testing
