#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/lattice/square/unit_laws.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/app/sweep/sweep.hpp"

namespace kinetix::testing {
namespace {

using Json = nlohmann::json;

std::string run_shipped(const Scratch& scratch, const std::string& name) {
  const std::string out = scratch / name;
  const Outcome run =
      kinetix_opt("sweep " + std::string(KINETIX_SOURCE) + "/targets/sweeps/" + name + ".yaml -o " + out);
  EXPECT_EQ(run.code, 0) << run.err;
  const Json summary = Json::parse(text_of(out + "/sweep.json"));
  EXPECT_EQ(summary["counts"]["ok"], summary["samples"]);
  EXPECT_EQ(schema_errors(summary, "sweep"), "");
  return out;
}

TEST(ShippedSweeps, AreThePapersEquations) {
  const Scratch scratch;
  const Csv area = read_csv(run_shipped(scratch, "eq3_area"));
  for (std::size_t row = 0; row < area.rows.size(); ++row)
    EXPECT_NEAR(area.number(row, "area_ratio"),
                model::area_ratio(area.number(row, "k"), 135 * radians_per_degree), 1e-12);
  const Csv shear = read_csv(run_shipped(scratch, "eq4_shear"));
  for (std::size_t row = 0; row < shear.rows.size(); ++row) {
    const double k = shear.number(row, "k");
    if (std::abs(k - 0.5) < 1e-9) continue;
    EXPECT_NEAR(shear.number(row, "cell_angle_deg"), 2 * model::shear_angle(k) / radians_per_degree, 1e-6);
  }
  const Csv crease = read_csv(run_shipped(scratch, "crease_law"));
  for (std::size_t row = 0; row < crease.rows.size(); ++row)
    EXPECT_NEAR(crease.number(row, "fold_deg"),
                model::crease_fold(crease.number(row, "design.columns[1].beta_deg") * radians_per_degree,
                                   crease.number(row, "design.theta_deg") * radians_per_degree) /
                    radians_per_degree,
                1e-5);
}

/// The drive reaches theta = 44.95 deg, so the unit is nearly in the state of Eq. 6. Barrier and joint separation grow
/// with 90 deg - alpha.
TEST(ShippedSweeps, TheTwistUnitComesToEquationSixOverItsBarrier) {
  const Scratch scratch;
  const Csv twist = read_csv(run_shipped(scratch, "eq6_twist"));
  for (std::size_t row = 0; row < twist.rows.size(); ++row) {
    const double lean =
        180 - model::twist_angle(twist.number(row, "alpha_deg") * radians_per_degree) / radians_per_degree;
    EXPECT_NEAR(twist.number(row, "lean_max_deg"), lean, 2e-3 * lean);
    if (row == 0) continue;
    EXPECT_LT(twist.number(row, "barrier_Nmm"), twist.number(row - 1, "barrier_Nmm"));
    EXPECT_LT(twist.number(row, "gap_peak"), twist.number(row - 1, "gap_peak"));
  }
}

/// Section 5.1: a smaller tolerance gives a higher resistance.
TEST(ShippedSweeps, LooserHingesResistLess) {
  const Scratch scratch;
  const Csv csv = read_csv(run_shipped(scratch, "hinge_tolerance"));
  ASSERT_EQ(csv.rows.size(), 15u);
  for (std::size_t row = 3; row < 15; ++row) {
    EXPECT_LT(csv.number(row, "energy_peak_Nmm"), csv.number(row - 3, "energy_peak_Nmm"));
    EXPECT_LT(csv.number(row, "load_peak"), csv.number(row - 3, "load_peak"));
  }
}

/// The hook meets the finger at 34.8 degrees. Below that angle only the joint's stiffness resists.
TEST(ShippedSweeps, AFingerIsStoppedByItsHook) {
  const Scratch scratch;
  const Csv csv = read_csv(run_shipped(scratch, "finger_stop"));
  ASSERT_EQ(csv.rows.size(), 36u);
  const double stop = std::atan2(8, 8) - std::asin(2 / std::hypot(8, 8));
  const double free = csv.number(4, "load_Nmm") /
                      csv.number(4, "angle_deg");  // slope without contact; the modulus is 1 there
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    const double angle = csv.number(row, "angle_deg"), moment = csv.number(row, "modulus") * free * angle;
    if (angle * radians_per_degree < stop) {
      EXPECT_EQ(csv.number(row, "contacts"), 0);
      EXPECT_NEAR(csv.number(row, "load_Nmm"), moment, 1e-6 * free);
    } else {
      EXPECT_GT(csv.number(row, "contacts"), 0);
      EXPECT_GT(csv.number(row, "load_Nmm"), 1.5 * moment);
    }
  }
}

/// Small errors change the shape in proportion.
TEST(ShippedSweeps, TolerancesStartFromTheBasesOwnState) {
  const Scratch scratch;
  const std::string base =
      std::string(strip) + "drive: {kind: hinge, wall: [[2, 0], [2, 1]], angle_deg: -40}\n";
  std::vector<double> moved;
  for (const char* sd : {"0.01", "0.02"}) {
    const std::string factors =
        std::string("  - {path: \"design.walls[*].beta_deg\", normal: {mean: 0, sd: ") + sd +
        "}, each: true, add: true}\n";
    const Outcome run =
        run_sweep_in(scratch,
                     sweep_of("{kind: monte_carlo, samples: 4}", factors, "moved_rms_mm, energy_Nmm",
                              "model: equilibrium\nstart: base\n"),
                     "", base);
    ASSERT_EQ(run.code, 0) << run.err;
    const Csv csv = read_csv(scratch / "out");
    EXPECT_EQ(csv.head.size(), 1 + 19 + 2 + 2u);
    moved.push_back(csv.number(2, "moved_rms_mm"));
    fs::remove_all(scratch / "out");
  }
  EXPECT_GT(moved[0], 0);
  EXPECT_NEAR(moved[1] / moved[0], 2, 0.02);
}

}  // namespace
}  // namespace kinetix::testing
