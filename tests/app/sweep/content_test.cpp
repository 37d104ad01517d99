#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "model/lattice/square/unit_laws.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/app/sweep/sweep.hpp"

namespace kinetix::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

/// Returns the result of `simulate` for one design in its target state.
Json simulated(const Scratch& scratch, const std::string& design, const std::string& model) {
  const std::string out = scratch / "single";
  const Outcome run =
      kinetix_opt("simulate " + scratch.write("single.yaml", design) + " --model " + model + " -o " + out);
  EXPECT_TRUE(run.code == 0 || run.code == 3) << run.err;  // also if walls meet
  return Json::parse(text_of(out + "/result.json"));
}

double distance_of_ends(const Json& result) {
  const auto& poses = result["states"][0]["poses"];
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += std::pow(
        poses.back()["position_mm"][k].get<double>() - poses.front()["position_mm"][k].get<double>(), 2);
  return std::sqrt(sum);
}

std::string with(double theta, double beta) {
  return fmt::format(
      "kinetix: 1\nstructure: {{cells: [6, 1], cell_mm: 10}}\ndesign:\n  theta_deg: {0}\n  hinges:\n"
      "    - {{wall: [[0, 0], [1, 0]], beta_deg: {1}}}\n    - {{wall: [[0, 1], [1, 1]], beta_deg: {2}}}\n",
      theta, beta, -beta);
}

TEST(SweepContent, EachRowOfAFactorialIsWhatSimulateGivesForThatDesign) {
  const Scratch scratch;
  const Outcome run =
      run_sweep_in(scratch, sweep_of("{kind: factorial}",
                                     "  - {path: design.theta_deg, range: [10, 30], levels: 3}\n"
                                     "  - {path: \"design.columns[0].beta_deg\", values: [-20, 45]}\n",
                                     "end_mm, theta_deg, hinge_gap_max"));
  ASSERT_EQ(run.code, 0) << run.err;
  const Csv csv = read_csv(scratch / "out");
  EXPECT_THAT(csv.head, ElementsAre("sample", "design.theta_deg", "design.columns[0].beta_deg", "end_mm",
                                    "theta_deg", "hinge_gap_max", "status", "reason"));
  ASSERT_EQ(csv.rows.size(), 6u);
  std::size_t row = 0;
  for (const double theta : {10, 20, 30})
    for (const double beta : {-20, 45}) {
      EXPECT_EQ(csv.number(row, "sample"), static_cast<double>(row));
      EXPECT_EQ(csv.number(row, "design.theta_deg"), theta);
      EXPECT_EQ(csv.number(row, "design.columns[0].beta_deg"), beta);
      EXPECT_EQ(csv.rows[row].at("status"), "ok");
      const Json single = simulated(scratch, with(theta, beta), "exact");
      EXPECT_NEAR(csv.number(row, "end_mm"), distance_of_ends(single), 1e-11);
      ++row;
    }
}

/// Returns sweep.json and checks it against its schema.
Json analysis_of(const Scratch& scratch) {
  Json json = Json::parse(text_of(scratch / "out/sweep.json"));
  EXPECT_EQ(schema_errors(json, "sweep"), "");
  return json;
}

TEST(SweepContent, CountsAllSamplesAndShowsALotOfThem) {
  const Scratch scratch;
  const Outcome run = run_sweep_in(
      scratch, sweep_of("{kind: factorial}",
                        "  - {path: design.theta_deg, range: [10, 30], levels: 250}\n"
                        "  - {path: \"design.columns[0].beta_deg\", range: [20, 40], levels: 10}\n",
                        "end_mm"));
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = analysis_of(scratch), &response = json["responses"][0];
  int counted = 0;
  for (const Json& bar : response["histogram"]) counted += bar.get<int>();
  EXPECT_EQ(counted, 2500);
  EXPECT_EQ(response["spread"]["count"], 2500);
  std::map<double, int> shown;
  for (const Json& row : json["scatter"]) ++shown[row[1].get<double>()];
  EXPECT_EQ(json["scatter"].size(), 2000u);
  ASSERT_EQ(shown.size(), 10u) << "every level of the factor that goes round fastest";
  for (const auto& [beta, count] : shown) EXPECT_NEAR(count, 200, 40) << beta;
}

TEST(SweepContent, PercentilesOfTwoSamplesLieBetweenThem) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: factorial}",
                                           "  - {path: design.theta_deg, values: [10, 30]}\n", "theta_deg"))
                .code,
            0);
  const Json spread = analysis_of(scratch)["responses"][0]["spread"];
  EXPECT_NEAR(spread["p05"], 11, 1e-9);
  EXPECT_NEAR(spread["median"], 20, 1e-9);
  EXPECT_NEAR(spread["p95"], 29, 1e-9);
}

// The distance of a straight strip's ends is cell_mm times a function of theta. The shares of a small grid add up to
// nearly 1.
TEST(SweepContent, SharesOfAGridAddUp) {
  const Scratch scratch;
  const std::string factors =
      "  - {path: structure.cell_mm, range: [10, 11], levels: 2}\n"
      "  - {path: design.theta_deg, range: [1, 25], levels: 2}\n";
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: factorial}", factors, "end_mm"), "",
                         "kinetix: 1\nstructure: {cells: [6, 1]}\ndesign: {theta_deg: 20}\n")
                .code,
            0);
  const Json response = analysis_of(scratch)["responses"][0], &families = response["families"];
  EXPECT_NEAR(families[0][0].get<double>() + families[1][0].get<double>(), response["linear"]["r_squared"],
              1e-9);
  EXPECT_GT(response["linear"]["r_squared"], 0.99);
  EXPECT_TRUE(response["main_effects"][0]["variance_interval"][0].is_null());
}

TEST(SweepContent, SharesOfDrawnSamplesHaveAnInterval) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: lhs, samples: 30}",
                                           "  - {path: structure.cell_mm, range: [10, 11]}\n"
                                           "  - {path: design.theta_deg, range: [15, 25]}\n",
                                           "end_mm"))
                .code,
            0);
  const Json analysis = analysis_of(scratch);
  for (const Json& share : analysis["responses"][0]["families"]) {
    EXPECT_LE(share[1].get<double>(), std::max(share[0].get<double>(), 0.0));
    EXPECT_GE(share[2], share[0]);
  }
}

TEST(SweepContent, SaysWhichFactorsChangeWhatTheBaseHas) {
  const Scratch scratch;
  const std::string factors =
      "  - {path: structure.cell_mm, scale: true, name: cell, range: [0.9, 1.1]}\n"
      "  - {path: \"design.columns[*].beta_deg\", each: true, add: true, range: [0, 5]}\n"
      "  - {path: design.theta_deg, range: [15, 20]}\n";
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: lhs, samples: 20}", factors, "end_mm")).code, 0);
  const Json said = analysis_of(scratch)["factors"];
  ASSERT_EQ(said.size(), 8u);
  EXPECT_EQ(said[0].value("scale", false), true);
  EXPECT_FALSE(said[0].contains("add"));
  for (int column = 1; column <= 6; ++column) EXPECT_EQ(said[column].value("add", false), true) << column;
  EXPECT_FALSE(said[7].contains("add") || said[7].contains("scale"));
}

TEST(SweepContent, DocumentKeysAndListedHingesGiveTheSameAsColumns) {
  const Scratch scratch;
  const std::string factors =
      "  - {path: [\"design.hinges[0].beta_deg\", {path: \"design.hinges[1].beta_deg\", times: -1}], name: "
      "tilt, "
      "values: [10, 50]}\n"
      "  - {path: structure.cell_mm, values: [10, 20]}\n";
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: factorial}", factors, "end_mm")).code, 0);
  const Csv csv = read_csv(scratch / "out");
  ASSERT_EQ(csv.rows.size(), 4u);
  for (const std::size_t row : {0, 2}) {
    EXPECT_NEAR(csv.number(row + 1, "end_mm"), 2 * csv.number(row, "end_mm"), 1e-10);
    const double tilt = csv.number(row, "tilt");
    EXPECT_NEAR(csv.number(row, "end_mm"), distance_of_ends(simulated(scratch, with(20, tilt), "exact")),
                1e-11);
  }
}

/// Compares sweeps of one cell or one crease with equations 3 and 4 and the crease law.
TEST(SweepContent, FollowsTheClosedFormsOfThePaper) {
  const Scratch scratch;
  const std::string cell = "kinetix: 1\nstructure: {cells: [1, 1]}\ndesign: {theta_deg: 67.5}\n";
  const std::string k =
      "  - {path: [\"design.columns[*].t\", \"design.rows[*].t\"], name: k, values: [0.1, 0.3, 0.8]}\n";
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: factorial}", k, "area_ratio"), "", cell).code, 0);
  const Csv scaled = read_csv(scratch / "out");
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_NEAR(scaled.number(row, "area_ratio"), model::final_area_ratio(scaled.number(row, "k")), 1e-12);

  const Scratch other;
  const std::string sheared = "kinetix: 1\nstructure: {cells: [1, 1]}\ndesign: {theta_deg: 45}\n";
  const std::string one_minus_k =
      "  - {path: [\"design.columns[*].t\", {path: \"design.rows[*].t\", times: -1, plus: 1}], name: k, "
      "values: [0.2, 0.7]}\n";
  ASSERT_EQ(
      run_sweep_in(other, sweep_of("{kind: factorial}", one_minus_k, "cell_angle_deg"), "", sheared).code, 0);
  const Csv angles = read_csv(other / "out");
  for (std::size_t row = 0; row < 2; ++row)
    EXPECT_NEAR(angles.number(row, "cell_angle_deg"),
                2 * model::shear_angle(angles.number(row, "k")) / radians_per_degree, 1e-9);
}

TEST(SweepContent, ACreaseFoldsAsItsLawSays) {
  const Scratch scratch;
  const std::string crease = "kinetix: 1\nstructure: {cells: [3, 1]}\ndesign: {theta_deg: 10}\n";
  const std::string factors =
      "  - {path: \"design.columns[1].beta_deg\", range: [5, 65], levels: 4}\n"
      "  - {path: design.theta_deg, range: [5, 45], levels: 3}\n";
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: factorial}", factors, "fold_deg"), "", crease).code, 0);
  const Csv csv = read_csv(scratch / "out");
  ASSERT_EQ(csv.rows.size(), 12u);
  for (std::size_t row = 0; row < csv.rows.size(); ++row)
    EXPECT_NEAR(csv.number(row, "fold_deg"),
                model::crease_fold(csv.number(row, "design.columns[1].beta_deg") * radians_per_degree,
                                   csv.number(row, "design.theta_deg") * radians_per_degree) /
                    radians_per_degree,
                1e-6);
}

TEST(SweepContent, ErrorsAreAddedToTheBasesOwnNumbersEachByItself) {
  const Scratch scratch;
  const std::string factors =
      "  - {path: \"design.hinges[*].beta_deg\", normal: {mean: 0, sd: 1}, each: true, add: true}\n";
  const Outcome run = run_sweep_in(scratch, sweep_of("{kind: monte_carlo, samples: 5}", factors,
                                                     "moved_max_mm, energy_Nmm", "model: equilibrium\n"));
  ASSERT_EQ(run.code, 0) << run.err;
  const Csv csv = read_csv(scratch / "out");
  EXPECT_EQ(csv.head[1], "design.hinges[0].beta_deg");
  EXPECT_EQ(csv.head[2], "design.hinges[1].beta_deg");
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    EXPECT_LE(std::abs(csv.number(row, "design.hinges[0].beta_deg")), 6);
    EXPECT_GT(csv.number(row, "moved_max_mm"), 0);
    EXPECT_LE(csv.number(row, "moved_max_mm"), 3);
  }
}

TEST(SweepContent, AEquilibriumIsWhatSimulateFinds) {
  const Scratch scratch;
  ASSERT_EQ(
      run_sweep_in(scratch, sweep_of("{kind: factorial}", "  - {path: hinge.k_turn, values: [0.05, 0.2]}\n",
                                     "energy_Nmm, load_N", "model: equilibrium\n"))
          .code,
      0);
  const Csv csv = read_csv(scratch / "out");
  const Json single = simulated(scratch, std::string(strip) + "hinge: {k_turn: 0.2}\n", "equilibrium");
  EXPECT_EQ(csv.number(1, "energy_Nmm"), single["metrics"]["energy_Nmm"].get<double>());
  EXPECT_EQ(csv.number(1, "load_N"), single["metrics"]["load_N"].get<double>());
}

/// If only the first column leans, a strip has an equilibrium on either side. A sample on the other side misses its
/// drive's target.
TEST(SweepContent, ASheetThatFoldsToTheOtherSideIsMissed) {
  const Scratch scratch;
  ASSERT_EQ(
      run_sweep_in(
          scratch,
          sweep_of("{kind: factorial}", "  - {path: design.theta_deg, values: [17.5]}\n",
                   "theta_deg, reached", "model: equilibrium\n"),
          "",
          "kinetix: 1\nstructure: {cells: [6, 2], cell_mm: 12, wall_mm: {thickness: 1, height: 8}}\n"
          "design:\n  theta_deg: 17.5\n  hinges:\n    - {wall: [[0, 0], [1, 0]], beta_deg: 20}\n"
          "    - {wall: [[0, 1], [1, 1]], beta_deg: -20}\n    - {wall: [[0, 2], [1, 2]], beta_deg: 20}\n"
          "hinge: {kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4}\n")
          .code,
      0);
  const Csv csv = read_csv(scratch / "out");
  const bool other = csv.number(0, "theta_deg") < 0;
  EXPECT_EQ(csv.rows[0].at("status"), other ? "missed" : "ok");
  EXPECT_EQ(csv.rows[0].at("reason").find("instead of the requested 17.50 deg") != std::string::npos, other);
}

// A strip in equilibrium that a hinge drives is inclined: its midline is not in the plane of x and z.
TEST(SweepContent, TurnsAreThoseOfTheSheetHoweverItLies) {
  const std::string bent =
      "kinetix: 1\nstructure: {cells: [6, 1], cell_mm: 10}\ndesign:\n  theta_deg: 20\n  hinges:\n"
      "    - {wall: [[0, 0], [1, 0]], beta_deg: 30}\n    - {wall: [[0, 1], [1, 1]], beta_deg: -30}\n"
      "    - {wall: [[3, 0], [4, 0]], beta_deg: 30}\n    - {wall: [[3, 1], [4, 1]], beta_deg: -30}\n"
      "hinge: {model: elastic}\ndrive: {kind: hinge, wall: [[2, 0], [2, 1]], angle_deg: -40}\n";
  for (const char* model : {"exact", "equilibrium", "bullet"}) {
    const Scratch scratch;
    ASSERT_EQ(run_sweep_in(scratch,
                           sweep_of("{kind: factorial}", "  - {path: drive.angle_deg, values: [-40]}\n",
                                    "turn_deg, fold_deg", std::string("model: ") + model + "\n"),
                           "", bent)
                  .code,
              0);
    const Csv csv = read_csv(scratch / "out");
    EXPECT_NEAR(csv.number(0, "turn_deg"), csv.number(0, "fold_deg"), 0.01) << model;
  }
}

TEST(SweepContent, PhysicsRunsInProcessesOfTheirOwnAgreeWithTheModel) {
  const Scratch scratch;
  const std::string small = "kinetix: 1\nstructure: {cells: [2, 1]}\ndesign: {theta_deg: 20}\n";
  ASSERT_EQ(run_sweep_in(scratch,
                         sweep_of("{kind: factorial}", "  - {path: design.theta_deg, values: [10, 25]}\n",
                                  "verify_rms, area_ratio", "model: bullet\n"),
                         "--threads 2", small)
                .code,
            0);
  const Csv csv = read_csv(scratch / "out");
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_LE(csv.number(row, "verify_rms"), 1e-4);
    EXPECT_NEAR(csv.number(row, "area_ratio"),
                model::area_ratio(0.5, 2 * csv.number(row, "design.theta_deg") * radians_per_degree), 1e-3);
  }
}

// Sheets without a closed form have elastic joints. The ends of a long strip then sway for longer than the simulated
// time.
TEST(SweepContent, APhysicsRunOfALongStripSettlesAsASingleOneDoes) {
  constexpr int columns = 150;
  std::string curl = fmt::format(
      "kinetix: 1\nstructure: {{cells: [{}, 1], cell_mm: 10, wall_mm: {{thickness: 0.5, height: 3}}}}\n"
      "design:\n  theta_deg: 15\n  hinges:\n",
      columns);
  for (int column = 0; column < columns; ++column)
    for (const int row : {0, 1})
      curl += fmt::format("    - {{wall: [[{0}, {2}], [{1}, {2}]], beta_deg: {3}}}\n", column, column + 1,
                          row, (column + row) % 2 == 0 ? 2 : -2);
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch,
                         sweep_of("{kind: factorial}", "  - {path: design.theta_deg, values: [15]}\n",
                                  "verify_rms", "model: bullet\n"),
                         "", curl)
                .code,
            0);
  const Csv csv = read_csv(scratch / "out");
  ASSERT_EQ(csv.rows[0].at("status"), "ok") << csv.rows[0].at("reason");
  EXPECT_LE(csv.number(0, "verify_rms"), 1e-5);
}

/// A straight strip that a tendon contracts.
const std::string corded =
    "kinetix: 1\nstructure: {cells: [6, 1], cell_mm: 10}\ndesign: {}\nhinge: {k_turn: 5}\n"
    "drive: {kind: cord, through: [[[0, 0], [0, 1]], [[6, 0], [6, 1]]], shorten_mm: 5}\n";

TEST(SweepContent, SamplesFromTheBasesStateSayOfTheSheetWhatIsKnownOfIt) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch,
                         sweep_of("{kind: factorial}", "  - {path: hinge.k_turn, values: [4, 5]}\n",
                                  "theta_deg, stable_states, reached", "model: equilibrium\nstart: base\n"),
                         "", corded)
                .code,
            0);
  const Csv csv = read_csv(scratch / "out");
  const double of_cord = std::acos(55.0 / 60) / radians_per_degree;
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_LT(csv.number(row, "theta_deg"), of_cord - 0.05) << "hinges that stretch shorten the cord as well";
    EXPECT_EQ(csv.rows[row].at("stable_states"), "");
    EXPECT_EQ(csv.number(row, "reached"), 1);
  }
  EXPECT_LT(csv.number(1, "theta_deg"), csv.number(0, "theta_deg") - 0.01);
}

TEST(SweepContent, ASampleWithoutAnEquilibriumNearTheBaseHasNoNumbers) {
  const Scratch scratch;
  ASSERT_EQ(
      run_sweep_in(scratch,
                   sweep_of("{kind: factorial}", "  - {path: \"design.walls[*].alpha_deg\", values: [30]}\n",
                            "moved_rms_mm, reached", "model: equilibrium\nstart: base\n"),
                   "",
                   "kinetix: 1\nstructure: {cells: [6, 1], cell_mm: 10}\ndesign: {theta_deg: 40}\n"
                   "hinge: {model: elastic}\n")
          .code,
      0);
  const Csv csv = read_csv(scratch / "out");
  EXPECT_EQ(csv.rows[0].at("status"), "failed");
  EXPECT_EQ(csv.rows[0].at("moved_rms_mm"), "");
  EXPECT_EQ(csv.rows[0].at("reached"), "") << "ends of its walls along such axes overlap in the flat state";
}

TEST(SweepContent, TheFirstSampleOfOneAtATimeIsTheBase) {
  const Scratch scratch;
  ASSERT_EQ(
      run_sweep_in(scratch,
                   sweep_of("{kind: one_at_a_time}",
                            "  - {path: {path: design.theta_deg, plus: 5}, name: more, add: true, range: "
                            "[0, 10], levels: 2}\n",
                            "theta_deg"))
          .code,
      0);
  const Csv csv = read_csv(scratch / "out");
  EXPECT_EQ(csv.number(0, "more"), -5);
  EXPECT_NEAR(csv.number(0, "theta_deg"), 20, 1e-12);
  EXPECT_NEAR(csv.number(1, "theta_deg"), 25, 1e-12);
}

TEST(SweepContent, AnAngleOfTheBaseIsAsItsFileHasIt) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch,
                         sweep_of("{kind: one_at_a_time}",
                                  "  - {path: \"design.columns[0].beta_deg\", values: [10, 30]}\n", "end_mm"))
                .code,
            0);
  EXPECT_EQ(read_csv(scratch / "out").rows[0].at("design.columns[0].beta_deg"), "30");
  const Json levels = analysis_of(scratch)["responses"][0]["main_effects"][0]["levels"];
  EXPECT_EQ(levels.size(), 2u) << "30 and 30.000000000000004 were two";
}

TEST(SweepContent, ATargetIsSearchedInEverySample) {
  const Scratch scratch;
  const std::string bow =
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [16, 17], [32, 27], [48, 30], [64, 27], "
      "[80, 17], [96, 0]]}\nstructure: {cells: [10, 1], cell_mm: 14}\n"
      "variables: {beta: {range_deg: [-60, 60]}}\nsolver: {starts: 2}\n";
  const std::string factors =
      "  - {path: [\"variables.beta.range_deg[1]\", {path: \"variables.beta.range_deg[0]\", "
      "times: -1}], name: bound, values: [5, 60]}\n";
  const Outcome moved =
      run_sweep_in(scratch, sweep_of("{kind: factorial}", factors, "moved_rms_mm"), "", bow);
  EXPECT_EQ(moved.code, 2) << "no search has a state of its base";
  EXPECT_THAT(moved.err, HasSubstr("`moved_rms_mm` is not a metric of this model"));
  const Outcome run = run_sweep_in(
      scratch, sweep_of("{kind: factorial}", factors, "shape_rms, met, theta_rad, hinge_gap_max, fold_deg"),
      "", bow);
  ASSERT_EQ(run.code, 0) << run.err;
  const Csv csv = read_csv(scratch / "out");
  EXPECT_EQ(csv.rows[0].at("status"), "missed");
  EXPECT_THAT(csv.rows[0].at("reason"), HasSubstr("bounds allow"));
  EXPECT_EQ(csv.rows[1].at("status"), "ok");
  EXPECT_LE(csv.number(1, "shape_rms"), 0.01);
  EXPECT_EQ(csv.number(1, "met"), 1);
  EXPECT_LT(csv.number(1, "hinge_gap_max"), 1e-9) << "of its state, where its metrics have none";
  EXPECT_GT(csv.number(1, "fold_deg"), 10) << "likewise: folds alone write a list of this name";
}

// The blocks would overlap junctions in the designs with the smallest print errors.
TEST(SweepContent, ARobustSearchTakesWhatASingleOneTakes) {
  const Scratch scratch;
  const std::string bend =
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [20, 0], [36, 12], [40, 32]]}\n"
      "structure: {wall_mm: {thickness: 1.6, height: 6}, cell_mm: 7}\n"
      "hinge: {kind: block, material: tango, gap_mm: 2.2}\ndrive: {kind: shape_memory, k_turn: 20}\n"
      "robust: true\nsolver: {starts: 2}\n";
  const std::string factors = "  - {path: structure.wall_mm.height, values: [6]}\n";
  const Outcome run =
      run_sweep_in(scratch, sweep_of("{kind: factorial}", factors, "theta_rad, met"), "", bend);
  ASSERT_EQ(run.code, 0) << run.err;
  kinetix_opt(scratch.write("bend.yaml", bend) + " --no-verify -o " + (scratch / "single").string());
  const Json single = Json::parse(text_of(scratch / "single/result.json"));
  const Csv csv = read_csv(scratch / "out");
  EXPECT_NEAR(csv.number(0, "theta_rad"), single["metrics"]["theta_rad"].get<double>(), 1e-12);
  EXPECT_EQ(csv.number(0, "met") == 1, single["metrics"]["met"].get<bool>());
}

TEST(SweepContent, AGoalWhoseWallsOverlapAsBuiltIsMissed) {
  const Scratch scratch;
  const std::string arch =
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [40, 12], [80, 16], [120, 12], [160, 0]]}\n"
      "structure: {cells: [17, 1], cell_mm: 10, wall_mm: {thickness: 0.8, height: 12.5}}\n"
      "variables: {theta: {range_deg: [3, 12]}, beta: {range_deg: [-70, 70]}}\n";
  const std::string factors = "  - {path: structure.wall_mm.height, values: [12.5]}\n";
  const Outcome run =
      run_sweep_in(scratch, sweep_of("{kind: factorial}", factors, "shape_rms, met"), "", arch);
  ASSERT_EQ(run.code, 0) << run.err;
  const Csv csv = read_csv(scratch / "out");
  EXPECT_EQ(csv.rows[0].at("status"), "missed");
  EXPECT_THAT(csv.rows[0].at("reason"), HasSubstr("overlap in the flat sheet"));
  EXPECT_EQ(csv.number(0, "met"), 0);
}

TEST(SweepContent, ASampleThatFailsIsRecordedWithItsReasonAndTheOthersGoOn) {
  const Scratch scratch;
  const std::string factors = "  - {path: \"design.hinges[0].beta_deg\", values: [30, 31, 30.0000000001]}\n";
  const Outcome run =
      run_sweep_in(scratch, sweep_of("{kind: factorial}", factors, "end_mm"), "--json --quiet");
  ASSERT_EQ(run.code, 0) << run.err;
  const Json summary = Json::parse(run.out);
  EXPECT_EQ(summary["ok"], 2);
  EXPECT_EQ(summary["failed"], 1);
  const Csv csv = read_csv(scratch / "out");
  EXPECT_EQ(csv.rows[1].at("status"), "failed");
  EXPECT_EQ(csv.rows[1].at("end_mm"), "");
  EXPECT_THAT(csv.rows[1].at("reason"), HasSubstr("all tilts of a column must be equal"));
}

TEST(SweepContent, AnalysisOfEveryMethodIsAsTheSchemaHasIt) {
  const std::string factors =
      "  - {path: design.theta_deg, range: [10, 30]}\n  - {path: \"design.columns[0].beta_deg\", range: "
      "[-20, 45]}\n";
  for (const char* method : {"{kind: factorial}", "{kind: lhs, samples: 20}", "{kind: sobol, samples: 16}",
                             "{kind: saltelli, samples: 8}", "{kind: monte_carlo, samples: 20}",
                             "{kind: one_at_a_time}", "{kind: morris, samples: 4}"}) {
    const Scratch scratch;
    const Outcome run = run_sweep_in(scratch, sweep_of(method, factors, "end_mm, turn_deg"));
    ASSERT_EQ(run.code, 0) << method << run.err;
    EXPECT_EQ(schema_errors(Json::parse(text_of(scratch / "out/sweep.json")), "sweep"), "") << method;
  }
}

TEST(SweepContent, SchemaRefusesWhatItShould) {
  const Scratch scratch;
  ASSERT_EQ(run_sweep_in(scratch, sweep_of("{kind: factorial}",
                                           "  - {path: design.theta_deg, range: [5, 40]}\n", "end_mm"))
                .code,
            0);
  Json analysis = Json::parse(text_of(scratch / "out/sweep.json"));
  EXPECT_EQ(schema_errors(analysis, "sweep"), "");
  analysis["counts"]["guessed"] = 1;
  EXPECT_EQ(schema_errors(analysis, "sweep"), "counts.guessed: the schema names no such key\n");
  analysis["counts"].erase("failed");
  analysis["method"] = "guess";
  EXPECT_THAT(schema_errors(analysis, "sweep"), HasSubstr("method"));
  EXPECT_THAT(schema_errors(analysis, "sweep"), HasSubstr("failed"));
}

TEST(SweepContent, WallsInARowHaveNoCellsToMeasure) {
  const Scratch scratch;
  const Outcome run = run_sweep_in(
      scratch,
      sweep_of("{kind: factorial}", "  - {path: design.theta_deg, values: [10]}\n",
               "area_ratio, fold_deg, cell_angle_deg, end_mm"),
      "",
      "kinetix: 1\nstructure: {lattice: graph, cell_mm: 20, vertices_mm: [[0, 0], [20, 0], [40, 0]], "
      "walls: [[0, 1], [1, 2]]}\ndesign: {theta_deg: 10}\n");
  ASSERT_EQ(run.code, 0) << run.err;
  const Csv csv = read_csv(scratch / "out");
  for (const char* metric : {"area_ratio", "fold_deg", "cell_angle_deg"})
    EXPECT_EQ(csv.rows[0].at(metric), "") << metric;
  EXPECT_NEAR(csv.number(0, "end_mm"), 40 * std::cos(10 * radians_per_degree), 1e-9);
}

// With one hinge off its middle, a honeycomb has no exact motion, so its hinges are strained.
TEST(SweepContent, TurnsTheKnobsOfAHoneycombByTheNumbersOfItsWalls) {
  const Scratch scratch;
  const auto design = [](double t, double theta) {
    return fmt::format(
        "kinetix: 1\nstructure: {{lattice: honeycomb, cells: [2, 2], rim: closed}}\n"
        "design: {{theta_deg: {1}, hinges: [{{wall: WALL, t: {0}}}]}}\nhinge: {{model: elastic}}\n",
        t, theta);
  };
  const auto named = [](std::string text, const std::string& wall) {
    return text.replace(text.find("WALL"), 4, wall);
  };
  const Json walls = simulated(scratch, named(design(0.5, 10), "[0, 3]"), "exact")["structure"]["hinges"];
  const std::string wall = walls[3]["bodies"].dump();
  scratch.write("comb.yaml", named(design(0.5, 10), wall));
  scratch.write(
      "doe.yaml",
      "kinetix: 1\nname: swept\nbase: comb.yaml\nmodel: equilibrium\nmethod: {kind: factorial}\nfactors:\n"
      "  - {path: \"design.walls[3].t\", values: [0.5, 0.52]}\n"
      "  - {path: design.theta_deg, values: [5, 10]}\nresponses: [energy_Nmm, theta_deg]\n");
  const Outcome run =
      kinetix_opt("sweep " + (scratch / "doe.yaml").string() + " -o " + (scratch / "out").string());
  ASSERT_EQ(run.code, 0) << run.err;
  const Csv csv = read_csv(scratch / "out");
  ASSERT_EQ(csv.rows.size(), 4u);
  std::size_t row = 0;
  for (const double t : {0.5, 0.52})
    for (const double theta : {5, 10}) {
      const Json alone = simulated(scratch, named(design(t, theta), wall), "equilibrium");
      EXPECT_EQ(csv.number(row, "design.walls[3].t"), t);
      EXPECT_NEAR(csv.number(row, "energy_Nmm"), alone["metrics"]["energy_Nmm"],
                  1e-6 * alone["metrics"]["energy_Nmm"].get<double>());
      ++row;
    }
  EXPECT_GT(csv.number(2, "energy_Nmm"), 1.001 * csv.number(0, "energy_Nmm"));
}

}  // namespace
}  // namespace kinetix::testing
