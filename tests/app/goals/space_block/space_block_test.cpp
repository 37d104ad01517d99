#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

TEST(SpaceBlockResult, ShrinksInPhysicsAsAsked) {
  const Scratch scratch;
  const Outcome run = kinetix_opt(KINETIX_SOURCE "/targets/shapes/shrinking_block.yaml -o " + scratch.path());
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_LE(result["metrics"]["factor_off"], 1e-12);
  EXPECT_LE(result["metrics"]["factor_off_physics"], 1e-4);
  EXPECT_LE(result["metrics"]["verify_rms"], 1e-2);
  EXPECT_TRUE(result["as_made"].contains("taken"));
  EXPECT_EQ(result["manufacture"]["hinge"]["kind"], "block");
  EXPECT_EQ(schema_errors(result), "");
  const std::string design = scratch / "design.yaml", folder = scratch / "again";
  const Outcome again = kinetix_opt("verify " + design + " -o " + folder);
  EXPECT_EQ(again.code, 0) << again.out << again.err;
}

TEST(SpaceBlockResult, WhoseWallsMeetIsNotSaidToMissItsFactors) {
  const Scratch scratch;
  const std::string file = scratch.write("block.yaml",
                                         "kinetix: 1\ntarget: {kind: space_block, factor: 0.9}\n"
                                         "structure: {cells: [1, 1, 1], wall_mm: {thickness: 30}}\n");
  const Outcome run = kinetix_opt(file + " --no-verify -o " + std::string(scratch / "out"));
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("goal missed"));
}

// Smaller cells of the same number would make a smaller block.
TEST(SpaceBlockResult, WhoseOwnCellsMissItsSizeAsksForOtherCells) {
  const Scratch scratch;
  const std::string file =
      scratch.write("block.yaml",
                    "kinetix: 1\ntarget: {kind: space_block, factor: 0.9, size_mm: [100, 100, 150]}\n"
                    "structure: {cells: [1, 1, 1]}\n");
  const Outcome run = kinetix_opt(file + " --no-verify -o " + std::string(scratch / "out"));
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("lengths at rest are up to 20.0 % off the requested lengths; at most 5 % is "
                                 "allowed: give other `cells`"));
}

// Gussets at the block's sides extend beyond the rotors, which define its lengths.
TEST(SpaceBlockTarget, IsForetoldAsLargeAsItsDesignIs) {
  const Scratch scratch;
  const std::string file =
      scratch.write("block.yaml",
                    "kinetix: 1\ntarget: {kind: space_block, factor: 0.85}\nstructure: "
                    "{cells: [1, 1, 1], cell_mm: 20, wall_mm: {thickness: 0.8, height: 3}}\n");
  ASSERT_NE(kinetix_opt(file + " --no-verify -o " + std::string(scratch / "out")).code, 2);
  const auto folded = [](const std::string& what) {
    const Json reported = Json::parse(kinetix_opt("check --json " + what).out);
    return reported["expected"]["folded_mm"].get<std::vector<double>>();
  };
  const std::vector<double> forecast_mm = folded(file), designed = folded(scratch / "out/design.yaml");
  ASSERT_EQ(forecast_mm.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(forecast_mm[k], designed[k], 1e-6);
}

TEST(SpaceBlockTarget, RefusesWhatNoBlockDoes) {
  const Scratch scratch;
  const auto refused = [&](const std::string& rest) {
    const Outcome run = kinetix_opt(
        "check " + scratch.write("block.yaml", "kinetix: 1\ntarget: {kind: space_block, " + rest + "\n"));
    EXPECT_EQ(run.code, 2) << rest;
    return run.err;
  };
  EXPECT_THAT(refused("factor: [0.6, 0.95, 0.95]}"),
              HasSubstr("block.yaml:2:37: target.factor: one direction shrinks by 0.4"));
  EXPECT_THAT(refused("factor: 0.3}"), HasSubstr("has all gussets from"));
  EXPECT_THAT(refused("factor: 1}"), HasSubstr("target.factor"));
  EXPECT_THAT(refused("factor: [0.9, 0.9]}"), HasSubstr("target.factor"));
  EXPECT_THAT(refused("factor: .nan}"), HasSubstr("target.factor"));
  EXPECT_THAT(refused("size_mm: [100, 100, 100]}"), HasSubstr("factor"));
  EXPECT_THAT(refused("factor: 0.9, size_mm: [100, 100, 0]}"), HasSubstr("target.size_mm"));
  EXPECT_THAT(refused("factor: 0.9, size_mm: [2000, 2000, 50]}"), HasSubstr("Give larger cells"));
  EXPECT_THAT(refused("factor: 0.9, size_mm: [1000, 1000, 1000]}\nstructure: {cell_mm: 0.88}"),
              HasSubstr("402 x 402 x 402 cells have about 2338733088 bodies"));
  EXPECT_THAT(refused("factor: 0.9}\ntolerance: {size: 0.01}"),
              HasSubstr("tolerance.size: only applies together with target.size_mm"));
}

}  // namespace
}  // namespace kinetix::testing
