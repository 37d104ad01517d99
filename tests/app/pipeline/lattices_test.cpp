#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/base/geometry.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* honeycomb = R"(kinetix: 1
name: comb
structure: {lattice: honeycomb, cells: [3, 3], rim: closed, cell_mm: 10}
design: {theta_deg: 12}
hinge: {model: elastic}
)";

constexpr const char* rhombi = R"(kinetix: 1
name: rhombi
structure: {lattice: rhombus, cells: [4, 3], angle_deg: 70, cell_mm: 12}
drive: {kind: plates, axis: y, compression: 0.06}
hinge: {model: elastic, k_turn: 0.2}
)";

// Two single walls without a cell.
constexpr const char* two_walls = R"(kinetix: 1
structure: {lattice: graph, vertices_mm: [[0, 0], [10, 0], [15, 8]], walls: [[0, 1], [1, 2]]}
design: {theta_deg: 10}
)";

const std::string rosette = KINETIX_SOURCE "/targets/shapes/rosette.yaml";

/// Returns the result of a run with a model and checks it against the schema.
Json simulated(const std::string& file, const std::string& model) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("simulate " + file + " --model " + model + " --quiet -o " + scratch.path());
  EXPECT_EQ(run.code, 0) << run.err;
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result.contains("physics"), model == "bullet");
  return result;
}

TEST(LatticeRuns, CheckFindsThemValid) {
  const Scratch scratch;
  for (const std::string& file :
       {rosette, scratch.write("c.yaml", honeycomb), scratch.write("r.yaml", rhombi)}) {
    const Outcome run = kinetix_opt("check " + file);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("valid design"));
  }
}

TEST(LatticeRuns, OfARosetteKeepToTheSchemaUnderEveryModel) {
  for (const std::string model : {"exact", "equilibrium", "bullet"}) {
    const Json result = simulated(rosette, model);
    EXPECT_EQ(result["structure"]["lattice"], "graph");
    EXPECT_EQ(result["plan"]["family"], "planar");
    EXPECT_EQ(result["structure"]["bodies"][7]["vertex"], Json({7}));
    EXPECT_NEAR(result["metrics"]["theta_rad"], 20 * radians_per_degree, 1e-9) << model;
    EXPECT_LE(result["metrics"].value("verify_rms", 0.0), 1e-6) << "of the physics run";
  }
}

TEST(LatticeRuns, OfAHoneycombNameItsCellsAndVertices) {
  const Scratch scratch;
  const Json result = simulated(scratch.write("c.yaml", honeycomb), "exact");
  const Json& structure = result["structure"];
  EXPECT_EQ(structure["lattice"], "honeycomb");
  EXPECT_EQ(structure["cells"][0]["cell"], Json({0, 0}));
  EXPECT_EQ(structure["cells"][0]["bodies"].size(), 6u);
  EXPECT_EQ(structure["cells"].back()["cell"], Json({structure["cells"].size() - 1}));
  EXPECT_NEAR(result["metrics"]["theta_rad"], 12 * radians_per_degree, 1e-12);
  EXPECT_LE(result["states"][0]["hinge_gap_max"], 1e-12);
}

TEST(LatticeRuns, SettleInTheEquilibriumThatThePhysicsRunFinds) {
  const Scratch scratch;
  for (const char* design : {honeycomb, rhombi}) {
    const std::string file = scratch.write("d.yaml", design);
    const Json alone = simulated(file, "equilibrium"), checked = simulated(file, "bullet");
    EXPECT_LE(alone["metrics"]["exact_rms"], 1e-2) << "one freedom: close to its exact motion";
    EXPECT_LE(checked["metrics"]["verify_rms"], 1e-2);
    EXPECT_EQ(checked["physics"]["comparison"]["outcome"], "agrees");
    EXPECT_EQ(checked["fidelity"].back()["against"], "equilibrium");
  }
}

TEST(LatticeRuns, WriteADesignThatRunsAlike) {
  const Scratch scratch;
  for (const std::string& file : {rosette, scratch.write("c.yaml", honeycomb)}) {
    const std::string out = scratch / "first";
    ASSERT_EQ(kinetix_opt("simulate " + file + " --quiet -o " + out).code, 0);
    const Json first = Json::parse(text_of(out + "/result.json"));
    const Json again = simulated(out + "/design.yaml", first["plan"]["model"]);
    EXPECT_EQ(first["states"], again["states"]);
    EXPECT_EQ(first["structure"], again["structure"]);
  }
}

TEST(LatticeRuns, OfSingleWallsHaveNoCells) {
  const Scratch scratch;
  const Json result = simulated(scratch.write("w.yaml", two_walls), "exact");
  EXPECT_EQ(result["structure"]["cells"], Json::array());
}

}  // namespace
}  // namespace kinetix::testing
