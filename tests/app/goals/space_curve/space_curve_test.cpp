#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace kinetix::testing
