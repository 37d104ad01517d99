#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

Json surface_result(const std::string& shape, const std::string& more) {
  const Scratch scratch;
  const std::string goal = "kinetix: 1\ntarget: {kind: surface, " + shape + "}\n" + more;
  const Outcome run = kinetix_opt(scratch.write("goal.yaml", goal) + " --no-verify -o " + scratch.path());
  EXPECT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
  return Json::parse(text_of(scratch / "result.json"));
}

TEST(SurfaceResult, OfASheetIsAsTheSchemaHasIt) {
  Json result = surface_result("shape: saddle, rise: 0.15", "structure: {facets: [2, 2]}\n");
  EXPECT_EQ(schema_errors(result), "");
  const Json& surface = result["surface"];
  EXPECT_EQ(surface["facets"], Json({2, 2}));
  EXPECT_EQ(surface["vertices_mm"].size(), surface["flat_mm"].size());
  EXPECT_EQ(surface["rms"], result["metrics"]["surface_rms"]);
  EXPECT_EQ(surface["rms"], surface["ways"][0]["rms"]);
  result["surface"]["guess"] = 1;
  EXPECT_EQ(schema_errors(result), "surface.guess: the schema names no such key\n");
  result["surface"].erase("guess");
  result["surface"].erase("multipliers");
  EXPECT_THAT(schema_errors(result), HasSubstr("multipliers"));
}

// The facets match the usual rise within the usual tolerance, but a cylinder does so, too.
TEST(SurfaceResult, OfASaddleSaysThatACylinderWouldDoAsWell) {
  const Json result =
      surface_result("shape: saddle", "structure: {facets: [4, 4]}\ntolerance: {shape: 0.05, cover: 0}\n");
  EXPECT_EQ(schema_errors(result), "");
  const Json& metrics = result["metrics"];
  EXPECT_EQ(metrics["met"], false);
  EXPECT_LE(metrics["curvature_share"], 1);
  EXPECT_NEAR(metrics["developable_rms"], 0.0157, 0.002);
  EXPECT_EQ(result["tolerance"]["curvature_share"], 0.5);
  EXPECT_THAT(result["surface"]["reasons"].dump(), HasSubstr("the best cylinder or cone"));
}

TEST(SurfaceResult, OfRibsIsAsTheSchemaHasIt) {
  Json result = surface_result("shape: cap, ribs: 3", "");
  EXPECT_EQ(schema_errors(result), "");
  const Json& surface = result["surface"];
  EXPECT_EQ(surface["ribs"].size(), 3u);
  EXPECT_EQ(surface["body_mm"].size(), result["structure"]["bodies"].size());
  EXPECT_EQ(surface["ways"][0]["way"], "fishbone");
  EXPECT_EQ(surface["covered_share"], result["metrics"]["covered_share"]);
  EXPECT_EQ(surface["goal_rms"], result["metrics"]["goal_rms"]);
  EXPECT_EQ(result["tolerance"]["covered_share"], 0.5);
  EXPECT_FALSE(result["tolerance"].contains("cover"));
  result["surface"].erase("spine_mm");
  EXPECT_THAT(schema_errors(result), HasSubstr("spine_mm"));
}

}  // namespace
}  // namespace kinetix::testing
