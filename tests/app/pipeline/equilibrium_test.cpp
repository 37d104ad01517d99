#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>

#include "app/files/design_file.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/result/summary.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

const double degree = std::acos(-1) / 180;  // rad: angles below are written in degrees

// A small planar panel, for short tests.
constexpr const char* panel = R"(kinetix: 1
name: panel
structure: {cells: [3, 3], cell_mm: 10}
drive: {kind: plates, axis: y, compression: 0.15}
hinge: {model: elastic, k_point: 1000, k_turn: 0.2, reach_mm: 1.8}
)";

// One twisting cell with the default hinges.
constexpr const char* twist_unit = R"(kinetix: 1
structure: {cells: [1, 1], cell_mm: 20}
design: {theta_deg: 30, pattern: {even: {A_in_deg: [90, 80, 90, 80]}}}
hinge: {model: elastic}
)";

Outcome equilibrium(const Scratch& scratch, const std::string& design, const std::string& more = "") {
  return kinetix_opt("simulate " + scratch.write("d.yaml", design) + " --model equilibrium --quiet " + more +
                     " -o " + scratch.path());
}

/// Counts the nulls, which replace numbers that are not finite in a file.
int nulls(const Json& value) {
  if (value.is_null()) return 1;
  int sum = 0;
  if (value.is_structured())
    for (const Json& entry : value) sum += nulls(entry);
  return sum;
}

TEST(Equilibrium, OfABasicPanelHasTheEnergyOfItsTurningHingesAndTheForceThatDoesTheWork) {
  const Scratch scratch;
  const Outcome run = equilibrium(scratch, panel);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr(", the end of the drive"));
  EXPECT_THAT(run.out, HasSubstr("event      bifurcation at compression"));
  EXPECT_THAT(run.out, HasSubstr("the equilibrium turned unstable: left along the"));
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["plan"]["model"], "equilibrium");
  const Json& found = result["equilibrium"];
  EXPECT_EQ(found["stop"], "reached");
  EXPECT_EQ(found["planar"], true);
  EXPECT_EQ(found["stiffness"],
            (Json{{"k_point", 1000.0}, {"k_turn", 0.2}, {"reach_mm", 1.8}, {"k_contact", 10000.0}}));
  EXPECT_EQ(nulls(found), 0);
  EXPECT_EQ(found["stable_states"].size(), 1u) << "flat";
  EXPECT_EQ(found["energy_barriers"].size(), 0u);

  const double theta = std::acos(0.85), hinges = 24;
  EXPECT_NEAR(result["metrics"]["theta_rad"], theta, 1e-12);
  EXPECT_NEAR(result["metrics"]["energy_Nmm"], hinges * 0.5 * 0.2 * std::pow(2 * theta, 2), 1e-3);
  const Json& path = found["path"];
  double work = path[1]["energy_Nmm"];
  for (std::size_t k = 2; k < path.size(); ++k)
    work += 30 * (path[k]["drive"].get<double>() - path[k - 1]["drive"].get<double>()) *
            (path[k]["load"].get<double>() + path[k - 1]["load"].get<double>()) / 2;
  EXPECT_NEAR(work, result["metrics"]["energy_Nmm"], 2e-3 * work);
  EXPECT_GT(result["metrics"]["load_N"], 0);
  EXPECT_LE(result["metrics"]["exact_rms"], 1e-4);
  EXPECT_EQ(result["states"][0]["model"], "equilibrium");
  EXPECT_EQ(result["states"][1]["model"], "exact");
  int frames = 0;
  for (const Json& state : result["states"]) frames += state["name"] == "frame";
  EXPECT_GE(frames, 10);
  EXPECT_LE(frames, 14);
  ASSERT_EQ(found["hinge_energy_Nmm"].size(), hinges);
  EXPECT_NEAR(found["hinge_energy_Nmm"][0]["turn"], 0.5 * 0.2 * std::pow(2 * theta, 2), 1e-4);
}

TEST(Equilibrium, OfATwistUnitStretchesItsHingesAndAgreesWithThePhysicsRun) {
  const Scratch scratch;
  const Outcome run = equilibrium(scratch, twist_unit, "--json");
  EXPECT_EQ(run.code, 0) << run.err;
  const Json result = Json::parse(run.out);
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["plan"]["family"], "none");
  EXPECT_EQ(result["equilibrium"]["planar"], false);
  EXPECT_GT(result["metrics"]["hinge_gap_max"], 1e-3);
  EXPECT_LT(result["metrics"]["hinge_gap_max"], 0.05);

  const Outcome verified = kinetix_opt("verify " + (scratch / "design.yaml").string() +
                                       " --json --quiet -o " + (scratch / "again").string());
  EXPECT_EQ(verified.code, 0) << verified.err;
  const Json physics = Json::parse(verified.out);
  EXPECT_EQ(schema_errors(physics), "");
  EXPECT_LE(physics["metrics"]["verify_rms"], 1e-4);
  EXPECT_EQ(physics["fidelity"].back()["against"], "equilibrium");
  EXPECT_EQ(physics["physics"]["comparison"]["outcome"], "agrees");
  for (const Json& state : physics["states"]) {
    if (state["model"] != "bullet") continue;
    for (const char* gap : {"hinge_gap_max", "hinge_gap_rms"})
      EXPECT_EQ(physics["metrics"][gap], state[gap]) << "both are of the physics run's state";
  }
}

// Plates of a block in space close in by more than the cosine of its theta.
TEST(Equilibrium, OfABlockInSpaceIsSavedWithTheThetaThatItWasAskedFor) {
  const Scratch scratch;
  const Outcome run = equilibrium(scratch,
                                  "kinetix: 1\nstructure: {lattice: sodalite, cells: [1, 1, 1], cell_mm: 20, "
                                  "gusset: 0.2}\ndesign: {theta_deg: 10}\nhinge: {model: elastic}\n");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(app::read_design((scratch / "design.yaml").string()).theta / degree, 10, 1e-9);
}

TEST(Equilibrium, OfATwistUnitDrivenOverItsBarrierHasTwoStableStates) {
  const Scratch scratch;
  const Outcome run = equilibrium(
      scratch,
      "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 20, wall_mm: {thickness: 0.4, height: 8}}\n"
      "design: {pattern: {even: {A_in_deg: [90, 80, 90, 80]}}}\n"
      "drive: {kind: hinge, wall: [[0, 0], [0, 1]], angle_deg: 80}\nhinge: {model: elastic, k_turn: "
      "0.001}\n");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("stable     2 states: flat, fold angle -4"));
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  const Json& found = result["equilibrium"];
  EXPECT_EQ(found["unresolved_releases"], Json::array());
  const Json& states = found["stable_states"];
  ASSERT_EQ(states.size(), 2u);
  EXPECT_EQ(states[0]["energy_Nmm"], 0);
  EXPECT_EQ(states[0]["drive"], 0);
  EXPECT_EQ(states[0]["how"], "flat");
  EXPECT_NEAR(states[1]["drive"], -2 * states[1]["theta_rad"].get<double>(), 0.1) << "of one of its hinges";
  EXPECT_EQ(states[1]["poses"].size(), 4u);

  ASSERT_EQ(found["energy_barriers"].size(), 1u);
  const Json& barrier = found["energy_barriers"][0];
  EXPECT_EQ(barrier["between"], (Json{0, 1}));
  EXPECT_EQ(barrier["balanced"], true);
  double top = 0;
  for (const Json& step : found["path"]) top = std::max(top, step["energy_Nmm"].get<double>());
  EXPECT_GE(barrier["energy_Nmm"], top);
  EXPECT_LT(barrier["energy_Nmm"], 1.1 * top);
  std::vector<std::string> events;
  for (const Json& event : found["events"]) events.push_back(event["kind"]);
  EXPECT_THAT(events, ::testing::IsSupersetOf({"limit point", "limit point"}));
}

TEST(Equilibrium, TakesTheOtherSignOfThetaAndADrivenHinge) {
  const Scratch scratch;
  const auto theta_and_energy = [&](const std::string& drive, const std::string& more = "") {
    const Outcome run = equilibrium(scratch, "kinetix: 1\nstructure: {cells: [2, 2], cell_mm: 10}\n" + drive,
                                    more + " --json");
    EXPECT_EQ(run.code, 0) << run.err;
    const Json metrics = Json::parse(run.out)["metrics"];
    return std::pair(metrics["theta_rad"].get<double>(), metrics["energy_Nmm"].get<double>());
  };
  const double theta = std::acos(0.85);
  const auto [forth, energy] = theta_and_energy("drive: {kind: plates, compression: 0.15}\n");
  EXPECT_NEAR(forth, theta, 1e-12);
  const auto [back, same] = theta_and_energy("drive: {kind: plates, compression: 0.15, branch: -1}\n");
  EXPECT_NEAR(back, -theta, 1e-12);
  EXPECT_NEAR(same, energy, 1e-6 * energy);
  const auto [asked, of_theta] = theta_and_energy("", "--theta-deg -31.788330617");
  EXPECT_NEAR(asked, -theta, 1e-9);
  EXPECT_NEAR(of_theta, energy, 1e-6 * energy);
  const auto [turned, of_hinge] =
      theta_and_energy("drive: {kind: hinge, wall: [[0, 0], [1, 0]], angle_deg: -63.576661234}\n");
  EXPECT_NEAR(turned, theta, 1e-9);
  EXPECT_NEAR(of_hinge, energy, 1e-3 * energy);
}

TEST(Equilibrium, ShowsItsWayToTheEnd) {
  const Scratch scratch;
  const Outcome run = equilibrium(scratch,
                                  "kinetix: 1\nstructure: {cells: [4, 4], cell_mm: 10}\n"
                                  "drive: {kind: hinge, wall: [[0, 0], [1, 0]], angle_deg: 40}\n",
                                  "--json");
  const Json states = Json::parse(run.out)["states"];
  EXPECT_EQ(states.back()["name"], "frame");
  EXPECT_NEAR(states.back()["theta_rad"].get<double>(), -20 * degree, 1e-6);
}

TEST(Equilibrium, SaysThatAnAngleTakesThePlaceOfTheFilesDrive) {
  const Scratch scratch;
  const std::string file = scratch.write("d.yaml", panel);
  const Outcome run = kinetix_opt("simulate " + file + " --model exact --theta-deg -20 --json -o " +
                                  (scratch / "out").string());
  EXPECT_NEAR(Json::parse(run.out)["metrics"]["theta_rad"].get<double>(), -20 * degree, 1e-12);
  EXPECT_THAT(run.err, HasSubstr("--fold-angle-deg replaces `drive:`"));
  const Outcome own = kinetix_opt("simulate " + file + " --model exact -o " + (scratch / "own").string());
  EXPECT_THAT(own.err, Not(HasSubstr("drive")));
}

/// Four cells in a row, the middle of three rows, each cell 10 mm wide.
const std::string corded = R"(kinetix: 1
name: corded
structure: {cells: [4, 3], cell_mm: 10}
drive:
  kind: cord
  through: [[[0, 1], [0, 2]], [[1, 1], [1, 2]], [[2, 1], [2, 2]], [[3, 1], [3, 2]], [[4, 1], [4, 2]]]
  shorten_mm: 4
hinge: {model: elastic, k_turn: 0.2}
)";

TEST(Equilibrium, OfACordHasTheTensionThatDoesTheWork) {
  const Scratch scratch;
  const Outcome run = equilibrium(scratch, corded);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("N at tendon shortened by 4 mm, the end of the drive"));
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  const Json& metrics = result["metrics"];
  EXPECT_NEAR(metrics["shortened_mm"], 4, 1e-9);
  const double theta = std::acos(0.9), hinges = 31;
  EXPECT_NEAR(metrics["theta_rad"], theta, 1e-3);
  EXPECT_NEAR(metrics["energy_Nmm"], hinges * 0.5 * 0.2 * std::pow(2 * theta, 2), 5e-3);
  EXPECT_NEAR(metrics["load_N"], hinges * 4 * 0.2 * theta / (40 * std::sin(theta)), 2e-3);
  EXPECT_LE(metrics["exact_rms"], 1e-3);
  EXPECT_EQ(result["equilibrium"]["path"][0]["drive_unit"], "mm");
  EXPECT_EQ(result["equilibrium"]["path"][0]["load_unit"], "N");

  const std::string again = (scratch / "design.yaml").string();
  const Outcome exact =
      kinetix_opt("simulate " + again + " --model exact --json --quiet -o " + (scratch / "exact").string());
  EXPECT_NEAR(Json::parse(exact.out)["metrics"]["theta_rad"], theta, 1e-9) << exact.err;
  const Outcome physics =
      kinetix_opt("verify " + scratch.write("d.yaml", corded) + " --json --quiet -o " + scratch.path());
  EXPECT_EQ(physics.code, 0) << physics.err;
  EXPECT_LE(Json::parse(physics.out)["metrics"]["verify_rms"], 1e-3);
}

// The drive's theta follows the length of the tendon and has the requested sign. The sheet twists to the other side.
TEST(Equilibrium, OfACordThatTwistsACellTellsItsBarrierAtTheThetaOfTheSheet) {
  const Scratch scratch;
  const Outcome run = equilibrium(
      scratch,
      "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 20, wall_mm: {thickness: 0.4, height: 8}}\n"
      "design: {pattern: {even: {A_in_deg: [90, 80, 90, 80]}}}\n"
      "drive: {kind: cord, through: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]], shorten_mm: 14}\n"
      "hinge: {model: elastic, k_turn: 0.001}\n");
  EXPECT_THAT(run.out, HasSubstr("event      slack at tendon shortened by"));
  EXPECT_THAT(run.out, HasSubstr("deg of the drive, load"));
  const Json found = Json::parse(text_of(scratch / "result.json"))["equilibrium"];
  ASSERT_EQ(found["stable_states"].size(), 2u);
  ASSERT_EQ(found["energy_barriers"].size(), 1u);
  const double barrier = found["energy_barriers"][0]["theta_rad"],
               twisted = found["stable_states"][1]["theta_rad"];
  EXPECT_LT(twisted, 0);
  EXPECT_GT(barrier, twisted) << "between flat and twisted";
  EXPECT_LT(barrier, 0.4 * twisted);
}

TEST(Equilibrium, OfShapeMemoryStopsWhereMomentsAreEqualAndAgreesWithThePhysicsRun) {
  const Scratch scratch;
  const std::string design =
      "kinetix: 1\nstructure: {cells: [3, 2], cell_mm: 10}\nhinge: {model: elastic, k_turn: 1}\n"
      "drive: {kind: shape_memory, angle_deg: 60, k_turn: 5}\n";
  const Outcome run =
      kinetix_opt("verify " + scratch.write("d.yaml", design) + " --json --quiet -o " + scratch.path());
  EXPECT_EQ(run.code, 0) << run.err;
  const Json result = Json::parse(run.out);
  EXPECT_EQ(schema_errors(result), "");
  const double angle = 60 * degree, hinges = 17;
  EXPECT_NEAR(result["metrics"]["theta_rad"], angle / 2 * 5 / 6, 1e-9);
  EXPECT_NEAR(result["metrics"]["energy_Nmm"], hinges * 5.0 / 6 * angle * angle / 2, 1e-6);
  EXPECT_NEAR(result["metrics"]["load_Nmm"], hinges * 5.0 / 6 * angle, 1e-6);
  EXPECT_LE(result["metrics"]["exact_rms"], 1e-6);
  EXPECT_LE(result["metrics"]["verify_rms"], 1e-6);
  const Json& springs = result["equilibrium"]["shape_memory"];
  EXPECT_EQ(springs["springs"], hinges);
  EXPECT_NEAR(springs["moment_mean_Nmm"], 5.0 / 6 * angle, 1e-9);
  EXPECT_NEAR(springs["energy_Nmm"], hinges * 2.5 * std::pow(angle / 6, 2), 1e-6);

  const std::string rotary =
      "kinetix: 1\nstructure: {cells: [3, 2]}\ndrive: {kind: shape_memory, angle_deg: 60, k_turn: 5}\n";
  const Outcome refused =
      kinetix_opt("verify " + scratch.write("r.yaml", rotary) + " --quiet -o " + (scratch / "p").string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("drive.kind: shape_memory needs elastic hinges"));
}

TEST(Equilibrium, TriesDrivesToTheSameThetaAndSaysWhichNeedsTheLeastForce) {
  const Scratch scratch;
  const std::string design = scratch.write("d.yaml",
                                           "kinetix: 1\nstructure: {cells: [4, 4], cell_mm: 10}\ndesign: "
                                           "{theta_deg: 25}\nhinge: {model: elastic}\n");
  const std::string command = "simulate " + design + " --model equilibrium --drives --quiet ";
  const Outcome table = kinetix_opt(command);
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("tendon along the middle row"));
  EXPECT_THAT(table.out, HasSubstr("least force"));
  const Outcome run = kinetix_opt(command + "--json -o " + scratch.path());
  const Json found = Json::parse(run.out);
  EXPECT_EQ(found, Json::parse(text_of(scratch / "drives.json")));
  const double theta = 25 * degree, hinges = 40, energy = hinges * 0.5 * 0.1 * std::pow(2 * theta, 2);
  ASSERT_EQ(found["drives"].size(), 6u);
  for (const Json& drive : found["drives"]) {
    EXPECT_EQ(drive["at_goal"], true) << drive;
    EXPECT_EQ(drive["stable"], true);
    EXPECT_EQ(drive["snaps"], 0);
    EXPECT_NEAR(drive["theta_rad"], theta, 5e-3 * theta);
    EXPECT_NEAR(drive["energy_Nmm"], energy, 0.02 * energy) << drive;
    EXPECT_NEAR(drive["work_Nmm"], energy, 0.02 * energy) << drive;
  }
  const double moment = found["drives"][2]["load_peak"];
  EXPECT_NEAR(moment, hinges * 0.1 * 2 * theta, 0.02 * moment) << "of one hinge, which turns all others";
  EXPECT_NEAR(found["drives"][2]["force_N"], moment / 10, 1e-12);

  const Outcome exact = kinetix_opt("simulate " + design + " --drives --quiet");
  EXPECT_EQ(exact.code, 2);
  EXPECT_THAT(exact.err, HasSubstr("--model equilibrium"));
  const Outcome opened = kinetix_opt(command + "--open");
  EXPECT_EQ(opened.code, 2);
  EXPECT_THAT(opened.err, HasSubstr("--open: --drives writes no report"));
  const Outcome flat =
      kinetix_opt("simulate " + scratch.write("f.yaml", "kinetix: 1\nstructure: {cells: [4, 4]}\n") +
                  " --model equilibrium --drives --quiet");
  EXPECT_EQ(flat.code, 2);
  EXPECT_THAT(flat.err, HasSubstr("the fold angle of the design is 0"));
}

TEST(Equilibrium, StoppedAmongDrivesComparesThoseTriedAndNamesTheOthers) {
  const Scratch scratch;
  const app::Design design =
      app::read_design(scratch.write("d.yaml",
                                     "kinetix: 1\nstructure: {cells: [4, 4], cell_mm: 10}\ndesign: "
                                     "{theta_deg: 25}\nhinge: {model: elastic}\n"));
  for (const std::size_t tried : {std::size_t{0}, std::size_t{2}}) {
    std::stop_source stopper;
    std::size_t begun = 0;
    app::RunOptions options;
    options.stop = stopper.get_token();
    options.progress = [&](const std::string&, double, const std::string&) {
      if (++begun > tried) stopper.request_stop();
    };
    const app::DriveTrials trials = app::try_drives(design, options);
    EXPECT_TRUE(trials.stopped);
    EXPECT_EQ(trials.trials.size(), tried);
    EXPECT_EQ(trials.not_tried.size(), 6 - tried);
    EXPECT_EQ(trials.not_tried.back(), "tendon along the middle column");
    const std::string text = summary(trials);
    EXPECT_THAT(text, HasSubstr("stopped; not tried: "));
    EXPECT_THAT(text, Not(HasSubstr("no drive reaches")));
    EXPECT_EQ(text.find("least force, of those tried  ") != std::string::npos, tried > 0) << text;
    const Json found = drive_trials_json(trials);
    EXPECT_EQ(found["stopped"], true);
    EXPECT_EQ(found["not_tried"].size(), 6 - tried);
    EXPECT_EQ(found["least_force"].is_null(), tried == 0);
  }
}

TEST(Equilibrium, OfRotaryHingesSaysThatItTakesThemAsElastic) {
  const Scratch scratch;
  const std::string start = "kinetix: 1\nstructure: {cells: [2, 2], cell_mm: 20}\ndesign: {theta_deg: 10}\n";
  const Json result = Json::parse(equilibrium(scratch, start, "--json").out);
  EXPECT_THAT(
      result["plan"]["why"].dump(),
      HasSubstr("revolute joints; this model assumes elastic hinges: k_point 1000 N/mm, k_turn 0.1 N mm/rad, "
                "reach_mm 3.6, k_contact 10000 N/mm"));
  const Outcome slack = equilibrium(scratch, start + "hinge: {model: rotary, k_turn: 0}\n");
  EXPECT_EQ(slack.code, 2);
  EXPECT_THAT(slack.err,
              HasSubstr("hinge.k_turn: 0 is out of range for elastic hinges. Give a number above 0"));
}

TEST(Equilibrium, OfAnOverdrivenPanelStopsAndSaysWhy) {
  const Scratch scratch;
  const Outcome run = equilibrium(scratch,
                                  "kinetix: 1\nname: thick\nhinge: {model: elastic}\n"
                                  "structure: {cells: [4, 4], cell_mm: 10, wall_mm: {thickness: 4}}\n"
                                  "drive: {kind: plates, axis: y, compression: 0.6}\n");
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\n  stopped "));
  EXPECT_THAT(run.out, HasSubstr("event      contact at compression 0.14"));
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(nulls(result), 4) << "the target, and what the verdict was not asked";
  EXPECT_NE(result["equilibrium"]["stop"], "reached");
  EXPECT_EQ(result["metrics"]["reached"], false);
  EXPECT_LT(result["metrics"]["compression"], 0.6);
  EXPECT_NEAR(result["metrics"]["theta_limit_rad"], 0.5404, 1e-3);
  EXPECT_THAT(text_of(scratch / "design.yaml"), HasSubstr("compression: 0.6}"));
  EXPECT_TRUE(fs::exists(scratch / "report.html"));
}

TEST(Equilibrium, ThatOverstretchesAHingeStopsAndSaysSoInPlainWords) {
  const Scratch scratch;
  const std::string design = scratch.write(
      "d.yaml",
      "kinetix: 1\nstructure: {cells: [3, 3], cell_mm: 10, wall_mm: {thickness: 0.1, height: 1}}\n"
      "drive: {kind: plates, axis: y, compression: 0.4}\nhinge: {model: elastic, k_turn: 100, k_point: 1}\n");
  const Outcome run = kinetix_opt("simulate " + design + " --model equilibrium -o " + scratch.path());
  EXPECT_EQ(run.code, 3) << run.out;
  EXPECT_THAT(run.out, HasSubstr("stopped    joint separated: the hinge on wall [["));
  EXPECT_THAT(run.out, HasSubstr("cell edges; at most 0.3 is allowed; at a fold angle of"));
  EXPECT_EQ(run.err, "equilibrium path ...\ncontact ...\nfiles ...\n");
  const Json result = Json::parse(text_of(scratch / "result.json"));
  EXPECT_EQ(result["equilibrium"]["stop"], "torn") << "a word of the file's format";
}

TEST(Equilibrium, OfNothingToDoIsTheFlatSheet) {
  const Scratch scratch;
  const Outcome run = equilibrium(scratch, "kinetix: 1\nstructure: {cells: [2, 1]}\n", "--json");
  EXPECT_EQ(run.code, 0) << run.err;
  const Json result = Json::parse(run.out);
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["metrics"]["energy_Nmm"], 0);
  EXPECT_EQ(result["equilibrium"]["path"].size(), 1u);
}

struct BadDesign {
  const char* name;
  std::string sections;
  std::string says;
};

void PrintTo(const BadDesign& bad, std::ostream* out) { *out << bad.name; }

class RefusedDesign : public ::testing::TestWithParam<BadDesign> {};

TEST_P(RefusedDesign, EndsWith2OneClearMessageAndNothingWritten) {
  const Scratch scratch;
  const std::string file = scratch.write("d.yaml", "kinetix: 1\n" + GetParam().sections + "\n"),
                    folder = scratch / "out";
  const Outcome run = kinetix_opt("simulate " + file + " --model equilibrium -o " + folder);
  EXPECT_EQ(run.code, 2) << run.out;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind(file + ":", 0), 0u) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr(GetParam().says));
  EXPECT_FALSE(fs::exists(folder));
}

// A valid structure for the files below. Each of them has another error.
const std::string sheet = "structure: {cells: [2, 2], cell_mm: 10}\n";

INSTANTIATE_TEST_SUITE_P(
    Equilibrium, RefusedDesign,
    ::testing::Values(
        BadDesign{"slack_hinges", sheet + "hinge: {model: elastic, k_turn: 0}", ":3:33: hinge.k_turn: "},
        BadDesign{"hinges_that_push", sheet + "hinge: {model: elastic, k_turn: -0.1}",
                  "above 0, in N mm/rad"},
        BadDesign{"points_that_push", sheet + "hinge: {model: elastic, k_point: -1000}",
                  ":3:34: hinge.k_point: "},
        BadDesign{"no_points", sheet + "hinge: {model: elastic, k_point: 0}", ":3:34: hinge.k_point: "},
        BadDesign{"infinite_points", sheet + "hinge: {model: elastic, k_point: .inf}", "not a finite number"},
        BadDesign{"points_past_numbers", sheet + "hinge: {model: elastic, k_point: 1e300}",
                  "k_point is 1e+300, must be positive, from 1e-30 to 1e+30"},
        BadDesign{"points_below_numbers", sheet + "hinge: {model: elastic, k_point: 1e-300}",
                  "k_point is 1e-300"},
        BadDesign{"soft_walls", sheet + "hinge: {model: elastic, k_contact: 0}", ":3:36: hinge.k_contact: "},
        BadDesign{"walls_of_nan", sheet + "hinge: {model: elastic, k_contact: .nan}", "hinge.k_contact: "},
        BadDesign{"no_reach", sheet + "hinge: {model: elastic, reach_mm: 0}", ":3:35: hinge.reach_mm: "},
        BadDesign{"misspelt", sheet + "hinge: {model: elastic, k_pont: 1}", "did you mean `k_point`?"},
        BadDesign{"walls_as_thick_as_half_a_cell",
                  "structure: {cells: [2, 2], cell_mm: 10, wall_mm: {thickness: 5}}",
                  ":2:62: structure.wall_mm.thickness: "},
        BadDesign{"walls_thicker_than_a_cell",
                  "structure: {cells: [2, 2], cell_mm: 10, wall_mm: {thickness: 12}}",
                  "less than half of cell_mm"},
        BadDesign{"walls_without_thickness",
                  "structure: {cells: [2, 2], cell_mm: 10, wall_mm: {thickness: 0}}",
                  "structure.wall_mm.thickness: "},
        BadDesign{"walls_of_atoms", "structure: {cells: [2, 2], cell_mm: 10, wall_mm: {thickness: 1e-300}}",
                  "a number of at least 0.00001 and below 5, in mm (less than half of cell_mm)"},
        BadDesign{"walls_without_height",
                  "structure: {cells: [2, 2], cell_mm: 10, wall_mm: {height: 1e-300}}",
                  "a number from 0.0001 to 10000, in mm"},
        BadDesign{"a_cell_twice", "structure: {cells: [[0, 0], [1, 0], [0, 0]]}",
                  "cell [0, 0] is listed twice"},
        BadDesign{"cells_apart", "structure: {cells: [[0, 0], [5, 5]]}",
                  "cell [5, 5] does not hang together"},
        BadDesign{"walls_that_overlap_flat",
                  "structure: {cells: [4, 2], cell_mm: 10, wall_mm: {height: 40}}\n"
                  "design: {theta_deg: 9, hinges: [{wall: [[0, 1], [1, 1]], beta_deg: 85}]}",
                  "overlap in the flat state. Make walls thinner, lower or less tilted"},
        BadDesign{"a_hinge_inside_a_wall",
                  sheet + "design: {theta_deg: 9, hinges: [{wall: [[0, 1], [1, 1]], t: 0.01}]}",
                  "overlap in the flat state"},
        BadDesign{"plates_that_meet", sheet + "drive: {kind: plates, compression: 1}",
                  ":3:36: drive.compression: "},
        BadDesign{"plates_past_each_other", sheet + "drive: {kind: plates, compression: 1.5}",
                  "above 0 and below 1"},
        BadDesign{"plates_that_pull", sheet + "drive: {kind: plates, compression: -0.1}",
                  "above 0 and below 1"},
        BadDesign{"a_full_turn", sheet + "drive: {kind: hinge, wall: [[0, 0], [1, 0]], angle_deg: 360}",
                  "above -180 and below 180"},
        BadDesign{"no_such_hinge", sheet + "drive: {kind: hinge, wall: [[7, 0], [8, 0]], angle_deg: 40}",
                  "drive.wall: the structure has no wall [[7, 0], [8, 0]]"},
        BadDesign{"no_cells", "structure: {}", "structure"}),
    [](const auto& tested) { return std::string(tested.param.name); });

/// If only the first column leans, a strip between plates has an equilibrium on either side. The result reports which
/// one it is.
TEST(Equilibrium, SaysWhereASheetFoldsToTheOtherSide) {
  const Scratch scratch;
  const Outcome run = equilibrium(
      scratch,
      "kinetix: 1\nstructure: {cells: [6, 2], cell_mm: 12, wall_mm: {thickness: 1, height: 8}}\n"
      "design:\n  theta_deg: 17.5\n  hinges:\n    - {wall: [[0, 0], [1, 0]], beta_deg: 20}\n"
      "    - {wall: [[0, 1], [1, 1]], beta_deg: -20}\n    - {wall: [[0, 2], [1, 2]], beta_deg: 20}\n"
      "hinge: {kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4}\n");
  const Json result = Json::parse(text_of(scratch / "result.json"));
  const double theta = result["metrics"]["theta_rad"];
  EXPECT_NEAR(std::abs(theta), 17.5 * degree, 1 * degree);
  EXPECT_EQ(result["equilibrium"]["other_side"], theta < 0);
  EXPECT_EQ(run.code, theta < 0 ? 3 : 0) << run.err;
  EXPECT_EQ(run.out.find("instead of the requested 17.50 deg") != std::string::npos, theta < 0) << run.out;
}

/// Compressions beyond the cells' limit and very different stiffnesses give an answer or a stop with its reason.
TEST(Equilibrium, WritesNoNumberThatIsNotFiniteHoweverFarItIsDriven) {
  for (const char* sections :
       {"drive: {kind: plates, compression: 0.999}\nhinge: {model: elastic}",
        "drive: {kind: plates, compression: 0.6}\nhinge: {model: elastic, k_contact: 1e30}",
        "drive: {kind: plates, compression: 0.3}\nhinge: {model: elastic, k_contact: 1e-30}",
        "drive: {kind: hinge, wall: [[0, 0], [1, 0]], angle_deg: 179.9}\nhinge: {model: elastic}",
        "drive: {kind: plates, compression: 1e-300}\nhinge: {model: elastic}",
        "drive: {kind: cord, through: [[[0, 0], [0, 1]], [[3, 0], [3, 1]]], shorten_mm: 29.9}\nhinge: "
        "{model: elastic}",
        "drive: {kind: cord, through: [[[0, 0], [0, 1]], [[2, 0], [2, 1]]], shorten_mm: 1e-300}\nhinge: "
        "{model: elastic}",
        "drive: {kind: shape_memory, angle_deg: 179.9, k_turn: 1e20}\nhinge: {model: elastic}",
        "drive: {kind: shape_memory, angle_deg: 1e-300, k_turn: 1e-30}\nhinge: {model: elastic}",
        "drive: {kind: plates, compression: 0.2}\nhinge: {model: elastic, k_turn: 1e30, k_point: 1e-28}",
        "drive: {kind: plates, compression: 0.2}\nhinge: {model: elastic, k_turn: 1e-30, k_point: 1e28}"}) {
    const Scratch scratch;
    const Outcome run =
        equilibrium(scratch, std::string("kinetix: 1\nstructure: {cells: [3, 3]}\n") + sections + "\n");
    EXPECT_TRUE(run.code == 0 || run.code == 3) << sections << run.err;
    const Json result = Json::parse(text_of(scratch / "result.json"));
    EXPECT_EQ(schema_errors(result), "");
    EXPECT_EQ(nulls(result), 4) << sections << ": the target, and what the verdict was not asked";
    EXPECT_EQ(result["equilibrium"]["stop"] == "reached", run.code == 0) << sections;
    EXPECT_THAT(text_of(scratch / "design.yaml"), Not(HasSubstr("nan")));
  }
}

}  // namespace
}  // namespace kinetix::testing
