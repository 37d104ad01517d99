#include <gmock/gmock.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/goals/registry.hpp"
#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/result/verdict.hpp"
#include "app/run/design_hinges.hpp"
#include "model/contact/wall_contact.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/app/searched_goal.hpp"

/// Tests of the contact part of results: collision-free ranges of theta.
namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A helix with alternating bending and shearing columns. Its turns touch at 25.1 deg; samples one degree apart detect
/// contact at 31.8 deg.
std::string helix_design(double theta_deg) {
  std::string hinges;
  for (int c = 0; c < 24; ++c)
    for (int j = 0; j < 2; ++j) {
      const std::string wall = "{wall: [[" + std::to_string(c) + ", " + std::to_string(j) + "], [" +
                               std::to_string(c + 1) + ", " + std::to_string(j) + "]], ";
      const bool is_in_sublattice_a = (c + j) % 2 == 0;
      hinges += "    - " + wall +
                (c % 2 == 0 ? std::string("beta_deg: ") + (j == 0 ? "35" : "-35")
                            : std::string("t: ") + (is_in_sublattice_a ? "0.35" : "0.65")) +
                "}\n";
    }
  return "kinetix: 1\nname: helix\nstructure: {cells: [24, 1], cell_mm: 10, wall_mm: {thickness: 0.8, "
         "height: "
         "2}}\ndesign:\n  theta_deg: " +
         std::to_string(theta_deg) + "\n  hinges:\n" + hinges;
}

struct Reported {
  Json result;
  std::string words;
};

Reported report_of(const std::string& text, const std::string& model) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("simulate " + scratch.write("in.yaml", text) + " --model " + model +
                                  " --quiet -o " + (scratch / "out").string());
  EXPECT_TRUE(run.code == 0 || run.code == 3) << run.out << run.err;
  Reported reported{Json::parse(text_of(scratch / "out/result.json")), run.out};
  EXPECT_EQ(schema_errors(reported.result), "");
  return reported;
}

const std::string small_panel =
    "kinetix: 1\nname: panel\nstructure: {cells: [3, 2], cell_mm: 10, wall_mm: {thickness: "
    "0.8, height: 6}}\ndesign: {theta_deg: 20}\n";

TEST(Certify, TellsTheClosedFormsEndOfAPanel) {
  const Reported reported = report_of(small_panel, "exact");
  const Json& certified = reported.result["certified"];
  const double closed = std::atan(1 - 0.08);
  EXPECT_NEAR(certified["design"]["high"]["theta_rad"].get<double>(), closed, 3e-7);
  EXPECT_LT(certified["design"]["high"]["theta_rad"].get<double>(), closed);
  EXPECT_NEAR(certified["design"]["low"]["contact_rad"].get<double>(), -closed, 3e-7);
  EXPECT_EQ(certified["design"]["high"]["walls"].size(), 2u);
  EXPECT_EQ(certified["covers_theta"], true);
  const double g = certified["printed"]["growth_mm"];
  EXPECT_NEAR(certified["printed"]["high"]["theta_rad"].get<double>(),
              std::atan((10 - 0.8 - 2 * g) / (10 + 2 * g)), 3e-7);
  EXPECT_THAT(reported.words, HasSubstr("collision-free -42.61 to 42.61 deg, limited by walls [["));
}

/// Three standard deviations of PolyJet: 0.05 mm, and 0.25 deg at the corner of a plate 5 mm long and 6 mm high.
TEST(Certify, GrowsWallsByWhatTheProcessLetsThemBeOff) {
  const model::Structure s = make_structure(model::rectangle(1, 1), {10, 0.8, 6});
  const double corner = std::sqrt(5 * 5 + 3 * 3 + 0.4 * 0.4);
  EXPECT_NEAR(app::print_growth_mm(s, {.t_mm = 0.05, .tilt_deg = 0.25}),
              0.15 + std::sin(0.75 * radians_per_degree) * corner, 1e-12);
}

/// The clearance of a pin tilts and shifts walls as print errors do.
TEST(Certify, GrowsWallsByWhatTheirPinsPlay) {
  const std::string sheet =
      "kinetix: 1\nname: panel\nstructure: {cells: [3, 2], cell_mm: 20, wall_mm: {thickness: 2, height: "
      "8}}\ndesign: {theta_deg: 10}\n";
  const auto growth = [&](const std::string& hinge) {
    return report_of(sheet + hinge, "exact").result["certified"]["printed"]["growth_mm"].get<double>();
  };
  const double plain = growth(""),
               tight = growth("hinge: {kind: pin, diameter_mm: 1.5, clearance_mm: 0.05}\n"),
               loose = growth("hinge: {kind: pin, diameter_mm: 1.5, clearance_mm: 0.1}\n");
  EXPECT_GT(tight, plain);
  EXPECT_GT(loose, tight + 3 * 0.05 / std::sqrt(3.0) / 2)
      << "three deviations of a place within the bore, and leaning";
}

TEST(Certify, SeesWhatSamplesMissOnTheWayToAHelix) {
  const Reported reported = report_of(helix_design(28), "exact");
  const Json& high = reported.result["certified"]["design"]["high"];
  EXPECT_LT(to_degrees(high["contact_rad"].get<double>()), 25.2);
  EXPECT_EQ(reported.result["metrics"]["theta_limit_rad"], high["theta_rad"]);
  EXPECT_THAT(reported.result["plan"]["why"].dump(),
              HasSubstr("walls already touch at a fold angle of 25.13 deg"));
  EXPECT_THAT(reported.words, HasSubstr("overlap at 25.1 deg, before the fold angle 28 deg"));
  EXPECT_EQ(reported.result["certified"]["covers_theta"], false);
  EXPECT_THAT(reported.words, HasSubstr("is outside the collision-free range"));
  EXPECT_EQ(report_of(helix_design(25), "exact").result["certified"]["covers_theta"], true);
}

TEST(Certify, SaysThatElasticHingesComeNearTheClosedFormAlone) {
  const Reported reported = report_of(small_panel + "hinge: {model: elastic}\n", "equilibrium");
  EXPECT_EQ(reported.result["certified"]["states_are_exact"], false);
  EXPECT_EQ(reported.result["certified"]["states_have_left"], false);
  EXPECT_THAT(reported.words,
              HasSubstr("computed for ideal hinges; the elastic solution stays close to this motion"));
}

/// One wall drives the bricks beyond the bifurcation. The closed form is free of contact, but too far from the
/// equilibrium to prove anything about it.
TEST(Certify, ProvesNothingOfAnEquilibriumThatHasLeftTheClosedForm) {
  const Reported reported = report_of(
      "kinetix: 1\nname: bricks\nstructure: {lattice: brick, cells: [3, 3], rim: closed, wall_mm: "
      "{thickness: 0.4}}\n"
      "design: {theta_deg: 30}\ndrive: {kind: hinge, wall: [0, 1], angle_deg: -60}\nhinge: {model: "
      "elastic}\n",
      "equilibrium");
  const Json& events = reported.result["equilibrium"]["events"];
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0]["kind"], "departure");
  EXPECT_THAT(reported.result["equilibrium"]["why"].get<std::string>(),
              HasSubstr("off the analytic motion since"));
  EXPECT_THAT(reported.words,
              HasSubstr("event      departure at hinge angle -27.5 deg, fold angle 13.75 deg"));
  EXPECT_THAT(reported.words,
              HasSubstr("collisions not checked: the elastic solution departs from the ideal motion"));
  EXPECT_THAT(reported.words, HasSubstr("ideal motion: collision-free "));
  EXPECT_EQ(reported.result["certified"]["states_have_left"], true);
}

TEST(Certify, SaysWhyNothingIsProvenWithoutAClosedForm) {
  const std::string leaning =
      "kinetix: 1\nname: leaning\nstructure: {cells: [2, 2]}\ndesign:\n  theta_deg: 5\n  hinges:\n    - "
      "{wall: [[0, 0], [1, 0]], beta_deg: 20}\nhinge: {model: elastic}\n";
  const Json certified = report_of(leaning, "equilibrium").result["certified"];
  EXPECT_EQ(certified.size(), 1u);
  EXPECT_THAT(certified["why_not"].get<std::string>(), HasSubstr("no exact family"));
}

// Walls 14 mm high that lean by 50 deg from a vertex cross the wall next to them, 10 mm away.
TEST(Certify, FindsWallsThatOverlapAsBuilt) {
  std::string hinges;
  for (int j = 0; j < 4; ++j)
    hinges += "    - {wall: [[2, " + std::to_string(j) + "], [3, " + std::to_string(j) +
              "]], beta_deg: " + (j % 2 == 0 ? "50" : "-50") + "}\n";
  const Reported reported = report_of(
      "kinetix: 1\nstructure: {cells: [6, 3], cell_mm: 10, wall_mm: {thickness: 0.8, height: "
      "14}}\ndesign:\n  theta_deg: 15\n  hinges:\n" +
          hinges,
      "exact");
  EXPECT_THAT(reported.words,
              HasSubstr("walls [[2, 0], [2, 1]] and [[2, 1], [3, 1]] overlap in the flat sheet"));
  const Json& certified = reported.result["certified"];
  EXPECT_EQ(certified["covers_theta"], false);
  EXPECT_EQ(certified["design"]["high"]["contact_rad"], 0.0);
  EXPECT_EQ(certified["design"]["low"]["theta_rad"], 0.0);
}

TEST(Certify, FailsGoalsWhoseWallsOverlapAsBuilt) {
  const Scratch scratch;
  const std::string file = scratch.write(
      "in.yaml",
      "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [40, 12], [80, 16], [120, 12], [160, 0]]}\n"
      "structure: {cells: [17, 1], cell_mm: 10, wall_mm: {thickness: 0.8, height: 12.5}}\n"
      "variables: {theta: {range_deg: [3, 12]}, beta: {range_deg: [-70, 70]}}\n");
  const app::Run run = run_goal(*app::read_target(file).goal, {.verify = false});
  ASSERT_TRUE(run.certified && run.certified->designed.overlaps_as_built());
  ASSERT_FALSE(run.met());
  EXPECT_THAT(run.violations.back(), HasSubstr("overlap in the flat sheet"));
  const app::Run unproven = run_goal(*app::read_target(file).goal, {.verify = false, .certify = false});
  EXPECT_FALSE(unproven.certified);
  EXPECT_EQ(verdict_of(unproven).met, false) << "as in a sweep";
  EXPECT_EQ(unproven.violations, run.violations);
}

TEST(Certify, ARunWhoseDriveStoppedOnItsWayMisses) {
  app::Run run;
  EXPECT_EQ(exit_code(verdict_of(run)), app::done);
  run.equilibrium.emplace();
  EXPECT_EQ(exit_code(verdict_of(run)), app::done);
  run.equilibrium->path.stop = model::EquilibriumPath::Stop::locked;
  EXPECT_EQ(exit_code(verdict_of(run)), app::target_missed);
}

TEST(Certify, IsPartOfACheck) {
  const Scratch scratch;
  const std::string file = scratch.write("in.yaml", helix_design(28));
  EXPECT_THAT(kinetix_opt("check " + file).out, HasSubstr("is outside the collision-free range"));
  const Json reported = Json::parse(kinetix_opt("check --json " + file).out);
  EXPECT_EQ(reported["certified"]["covers_theta"], false);
  EXPECT_FALSE(
      Json::parse(kinetix_opt("check --json " +
                              std::string(scratch.write("e.yaml", small_panel + "hinge: {model: elastic}\n")))
                      .out)
          .contains("certified"));
}

/// Tests small shipped targets of every kind with an exact motion. kinetix-bench --only certified covers the larger
/// ones.
TEST(Certify, CoversShippedTargetsWithinOnePercentOfWallsThatOverlap) {
  for (const char* name : {"helmet_rib", "half_circle", "s_curve", "cube", "open_tray", "tetrahedron",
                           "octahedron", "helix", "shrinking_block", "headform", "disc"}) {
    const app::Run run = searched_goal(
        *app::read_target(std::string(KINETIX_SOURCE) + "/targets/shapes/" + name + ".yaml").goal);
    const app::ProvenRanges certified =
        certify(run.design.structure, run.plan, wall_error(run.design), 0, {});
    ASSERT_TRUE(certified.designed) << name;
    EXPECT_TRUE(certified.designed.covers(run.theta)) << name;
    for (const model::ContactLimit* end : {&certified.designed.negative, &certified.designed.positive}) {
      ASSERT_TRUE(end->contact) << name;
      EXPECT_GE(std::abs(end->theta), 0.99 * std::abs(*end->contact)) << name;
      model::WallContact contact(run.design.structure);
      EXPECT_TRUE(contact.overlapping(run.plan.exact.at(end->theta)).empty()) << name;
      EXPECT_FALSE(contact.overlapping(run.plan.exact.at(*end->contact * (1 + 1e-6))).empty()) << name;
    }
    EXPECT_LT(certified.printed.positive.theta, certified.designed.positive.theta) << name;
  }
}

}  // namespace
}  // namespace kinetix::testing
