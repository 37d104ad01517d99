#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cad/cad_formats.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/app/sweep/sweep.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;

constexpr double arm_mm = 4.75;  // mm: from the middle of a wall to the hinge

/// Imports two walls of 0.8 x 6 mm with a block of 1 mm between them. Writes imported/design.yaml into the folder.
void import_pair(const Scratch& scratch) {
  model::Polyhedron hard = box_solid(-9, -0.5, 0.8, 6);
  append(box_solid(0.5, 9, 0.8, 6), hard);
  const std::string soft = app::stl_text("soft", box_solid(-0.5, 0.5, 0.8, 6));
  const Outcome run =
      kinetix_opt("import --hard " + scratch.write("hard.stl", app::stl_text("hard", hard)) + " --soft " +
                  scratch.write("soft.stl", soft) + " --unit mm -o " + (scratch / "imported").string());
  ASSERT_EQ(run.code, 0) << run.err;
}

std::string pair_sweep(const std::string& model, const std::string& factors, const std::string& responses,
                       const std::string& more = {}) {
  return "kinetix: 1\nname: swept\nbase: imported/design.yaml\nmodel: " + model +
         "\nmethod: {kind: factorial}\nfactors:\n" + factors + "responses: [" + responses + "]\n" + more;
}

Outcome sweep_pair(const Scratch& scratch, const std::string& doe, const std::string& arguments = {}) {
  return kinetix_opt("sweep " + scratch.write("doe.yaml", doe) + " -o " + (scratch / "out").string() + " " +
                     arguments);
}

Csv swept(const Scratch& scratch, const std::string& doe, const std::string& arguments = {}) {
  const Outcome run = sweep_pair(scratch, doe, arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  return read_csv(scratch / "out");
}

std::string angles(const std::string& values) {
  return "  - {path: drive.angle_deg, name: angle, values: [" + values + "]}\n";
}

TEST(SweepOfBodies, TurnsAHingeAsItsClosedFormSays) {
  const Scratch scratch;
  import_pair(scratch);
  const Csv csv = swept(scratch, pair_sweep("exact", angles("0, 20, 50"),
                                            "theta_deg, end_mm, size_x_mm, size_y_mm, size_z_mm, "
                                            "hinge_gap_max, moved_max_mm"));
  ASSERT_EQ(csv.rows.size(), 3u);
  for (std::size_t row = 0; row < 3; ++row) {
    const double half = csv.number(row, "angle") / 2;
    EXPECT_EQ(csv.rows[row].at("status"), "ok");
    EXPECT_NEAR(std::abs(csv.number(row, "theta_deg")), half, 1e-9);
    EXPECT_NEAR(csv.number(row, "end_mm"), 2 * arm_mm * std::cos(half * radians_per_degree), 1e-6);
    EXPECT_LT(csv.number(row, "hinge_gap_max"), 1e-9);
    EXPECT_NEAR(csv.number(row, "size_z_mm"), 6, 1e-6);
  }
  EXPECT_NEAR(csv.number(0, "size_x_mm"), 18, 1e-6);
  EXPECT_NEAR(csv.number(0, "size_y_mm"), 0.8, 1e-6);
  EXPECT_EQ(schema_errors(nlohmann::json::parse(text_of(scratch / "out/sweep.json")), "sweep"), "");
}

TEST(SweepOfBodies, ResistsByTheStiffnessThatAFactorSetsOrMultiplies) {
  const Scratch scratch;
  import_pair(scratch);
  const double turn = 40 * radians_per_degree;
  const Csv set =
      swept(scratch, pair_sweep("equilibrium",
                                angles("40") + "  - {path: \"structure.hinges[0].k.turn\", name: k, "
                                               "values: [5, 12]}\n",
                                "load_Nmm, energy_Nmm, reached, contacts, exact_max"));
  for (std::size_t row = 0; row < 2; ++row) {
    const double k = set.number(row, "k");
    EXPECT_NEAR(set.number(row, "load_Nmm"), k * turn, 1e-6 * k);
    EXPECT_NEAR(set.number(row, "energy_Nmm"), k * turn * turn / 2, 1e-6 * k);
    EXPECT_EQ(set.number(row, "reached"), 1);
    EXPECT_EQ(set.number(row, "contacts"), 0);
    EXPECT_LT(set.number(row, "exact_max"), 1e-6);
  }
  fs::remove_all(scratch / "out");
  const Csv scaled = swept(
      scratch, pair_sweep("equilibrium",
                          angles("40") + "  - {path: [\"structure.hinges[*].k.axial\", "
                                         "\"structure.hinges[*].k.shear\", \"structure.hinges[*].k.along\", "
                                         "\"structure.hinges[*].k.turn\"], name: modulus, scale: true, "
                                         "values: [0.5, 1, 3]}\n",
                          "load_Nmm"));
  for (const std::size_t row : {0u, 2u})
    EXPECT_NEAR(scaled.number(row, "load_Nmm"), scaled.number(row, "modulus") * scaled.number(1, "load_Nmm"),
                1e-6);
}

/// The corners of the walls meet at tan(phi / 2) = L / t: 102.7 degrees.
TEST(SweepOfBodies, StopsWhereWallsMeet) {
  const Scratch scratch;
  import_pair(scratch);
  const std::string turned = angles("95, 106");
  const double k = 5, axial = 7;
  const Csv pressed = swept(
      scratch, pair_sweep("equilibrium",
                          turned + "  - {path: \"structure.hinges[0].k.turn\", name: k, values: [5]}\n" +
                              "  - {path: \"structure.hinges[0].k.axial\", name: axial, values: [7]}\n",
                          "load_Nmm, contacts, gap_peak"));
  EXPECT_EQ(pressed.number(0, "contacts"), 0);
  EXPECT_NEAR(pressed.number(0, "load_Nmm"), k * 95 * radians_per_degree, 1e-5);
  EXPECT_GT(pressed.number(1, "contacts"), 0);
  // Beyond contact, rigid corners would stretch the block by h = t sin(phi / 2) - L cos(phi / 2), with the moment
  // k_axial h h'.
  const double half = 53 * radians_per_degree, free = k * 2 * half;
  const double rigid =
      axial * (0.8 * std::sin(half) - std::cos(half)) * (0.4 * std::cos(half) + 0.5 * std::sin(half));
  EXPECT_GT(pressed.number(1, "load_Nmm"), free + 0.5 * rigid);
  EXPECT_LT(pressed.number(1, "load_Nmm"), free + rigid);
  fs::remove_all(scratch / "out");
  const Csv fallen = swept(scratch, pair_sweep("bullet", turned, "verify_rms, hinge_gap_max"));
  EXPECT_EQ(fallen.rows[0].at("status"), "ok");
  EXPECT_LT(fallen.number(0, "verify_rms"), 1e-3);
  EXPECT_EQ(fallen.rows[1].at("status"), "failed");
  EXPECT_THAT(fallen.rows[1].at("reason"), HasSubstr("simulation blocked"));
}

TEST(SweepOfBodies, IsTheSameForAnyNumberOfThreads) {
  const Scratch scratch;
  import_pair(scratch);
  for (const char* model : {"exact", "equilibrium"}) {
    const std::string doe = pair_sweep(model, angles("10, 30, 60, 104, 105, 106"), "end_mm, size_y_mm");
    std::vector<std::string> tables;
    for (const char* threads : {"--threads 1", "--threads 3"}) {
      EXPECT_EQ(sweep_pair(scratch, doe, threads).code, 0);
      tables.push_back(text_of(scratch / "out/samples.csv"));
      fs::remove_all(scratch / "out");
    }
    EXPECT_EQ(tables[0], tables[1]);
  }
}

TEST(SweepOfBodies, RefusesWhatIsForSheets) {
  const Scratch scratch;
  import_pair(scratch);
  const std::string angle = angles("10, 30");
  const std::string equilibrium = pair_sweep("equilibrium", angle, "end_mm");
  const std::pair<std::string, std::string> bad[] = {
      {equilibrium + "start: base\n", "start: only applies to sheets"},
      {equilibrium + "goal: curve.yaml\n", "goal: only applies to sheets"},
      {pair_sweep("exact", angle, "area_ratio"), "`area_ratio` is not a metric of this model"},
      {pair_sweep("exact", angle, "load_Nmm"), "`load_Nmm` is not a metric of this model"},
      {pair_sweep("equilibrium", angle, "stable_states"), "`stable_states` is not a metric of this model"},
      {pair_sweep("exact", angles("10, 190"), "end_mm"), "190"},
      {pair_sweep("exact", "  - {path: drive.angle, values: [1]}\n", "end_mm"),
       "Did you mean `drive.angle_deg`?"},
      {pair_sweep("exact", "  - {path: \"structure.hinges[1].k.turn\", values: [1]}\n", "end_mm"),
       "no such entry. Count positions from 0"},
      {pair_sweep("exact", "  - {path: \"structure.hinges[0].k.turn\", scale: true, values: [-1]}\n",
                  "end_mm"),
       "structure.hinges[0].k.turn"},
      {pair_sweep("exact", "  - {path: structure.cell_mm, scale: true, add: true, values: [1]}\n", "end_mm"),
       "`add: true` and `scale: true`"}};
  for (const auto& [doe, says] : bad) {
    const Outcome run = sweep_pair(scratch, doe);
    EXPECT_EQ(run.code, 2) << doe;
    EXPECT_THAT(run.err, HasSubstr(says));
    EXPECT_FALSE(fs::exists(scratch / "out")) << doe;
  }
}

}  // namespace
}  // namespace kinetix::testing
