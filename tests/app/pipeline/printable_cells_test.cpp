#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "app/files/design_file.hpp"
#include "app/goals/registry.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/result/result_json.hpp"
#include "app/result/verdict.hpp"
#include "app/run/design_hinges.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using app::Design;
using app::Folding;
using app::Goal;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* rainbow =
    "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n";

app::RunOptions printable_options() {
  app::RunOptions options;
  options.verify = false;
  options.printable = app::answer_of_export;
  options.printable_size = app::find_printable_size;
  return options;
}

app::Run run_of(const Scratch& scratch, const std::string& text) {
  return run_goal(*app::read_target(scratch.write("goal.yaml", text)).goal, printable_options());
}

const model::CellSize& size_of(const app::Run& run) { return run.design.structure.size(); }

// FDM prints pins in cells of some 12 mm. Forty cells of a curve of 130 mm would be 4 mm.
TEST(PrintableCells, OfACurveBecomeFewerIfTheFileLeavesThemOpen) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, std::string(rainbow) + "process: fdm\n");
  ASSERT_TRUE(run.print);
  EXPECT_TRUE(run.print->is_accepted) << run.print->why;
  EXPECT_TRUE(run.met()) << run.violations.front();
  EXPECT_GE(size_of(run).thickness_mm, model::find_process("fdm")->min_wall_mm);
  EXPECT_TRUE(app::answer_of_export(app::written_design(run)).is_accepted);
}

// Keys that the file gives stay. The advice is read again as a user would, and works.
TEST(PrintableCells, AdviceForCellsThatTheFileGivesWorks) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, std::string(rainbow) + "process: fdm\nstructure: {cells: [24, 1]}\n");
  EXPECT_EQ(run.design.structure.squares()->cells.size(), 24u);
  ASSERT_TRUE(run.print);
  const std::string why =
      (!run.print->is_accepted ? run.print->why : run.folding.value_or(Folding{}).why_not) +
      run.print->advice;
  const std::size_t from = why.find("`structure: "), to = why.find('`', from + 1);
  ASSERT_NE(from, std::string::npos) << why;
  const std::string keys = why.substr(from + 1, to - from - 1);
  const app::Run advised = run_of(scratch, std::string(rainbow) + "process: fdm\n" + keys + "\n");
  EXPECT_TRUE(advised.met());
  EXPECT_TRUE(advised.print->is_accepted) << keys << advised.print->why;
  EXPECT_TRUE(advised.folding->turns_freely);
}

/// Returns the target of a handle, a fraction as large as the shipped one.
std::string smaller_handle(double share) {
  std::stringstream file(text_of(fs::path(KINETIX_SOURCE) / "targets/shapes/handle.csv"));
  std::string line, points;
  std::getline(file, line);  // the header
  char comma = 0;
  for (double x = 0, y = 0, z = 0; file >> x >> comma >> y >> comma >> z;)
    points += fmt::format("{}[{}, {}, {}]", points.empty() ? "" : ", ", share * x, share * y, share * z);
  return "kinetix: 1\ntarget: {kind: space_curve, points: [" + points +
         "]}\nprocess: fdm\ntolerance: {shape: 0.005}\n";
}

// The size that the pins of 24 columns need leaves too few columns for the curve. The search tries numbers in between.
TEST(PrintableCells, OfACurveInSpaceBecomeFewerButNotTooFew) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, smaller_handle(100.0 / 128));
  ASSERT_TRUE(run.print);
  EXPECT_TRUE(run.print->is_accepted) << run.print->why << run.print->advice;
  EXPECT_TRUE(run.met()) << run.violations.front();
  EXPECT_TRUE(run.folding && run.folding->turns_freely);
}

// Cells between given walls are as large as those leave room, instead of an error about walls of half a cell.
TEST(PrintableCells, OfACurveInSpaceLeaveRoomForGivenWalls) {
  const Scratch scratch;
  for (const char* walls : {"{thickness: 0.8, height: 4}", "{thickness: 1.5}"})
    EXPECT_NO_THROW(run_of(scratch, smaller_handle(100.0 / 128) + "structure: {wall_mm: " + walls + "}\n"));
  EXPECT_NO_THROW(run_of(scratch, smaller_handle(100.0 / 128) +
                                      "structure: {cells: [80, 1], wall_mm: {thickness: 0.8, height: 4}}\n"));
}

// A panel that is cut from a sheet has room for its bridges if the file leaves sizes open.
/// Bridges of default size hold the panel back, so that its letter does not show.
TEST(PrintableCells, OfALetterThatIsCutLeaveRoomForBridges) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, "kinetix: 1\ntarget: {kind: display, glyph: T}\nprocess: laser\n");
  ASSERT_TRUE(run.print);
  EXPECT_TRUE(run.print->is_accepted) << run.print->why;
  ASSERT_TRUE(run.design.hinge.made);
  EXPECT_EQ(run.design.hinge.made->kind, model::HingeKind::film);
  EXPECT_FALSE(run.met());
}

TEST(PrintableCells, OfALetterLeaveRoomForPins) {
  const Scratch scratch;
  const app::Run run =
      run_of(scratch, "kinetix: 1\ntarget: {kind: display, glyph: T}\nstructure: {cells: [10, 10]}\n");
  ASSERT_TRUE(run.print);
  EXPECT_TRUE(run.print->is_accepted) << run.print->why;
  EXPECT_TRUE(has_pins_alone(run.design));
  EXPECT_TRUE(run.met());
}

TEST(PrintableCells, OfAPanelThatStretchesAreNotSearchedForUnknownHinges) {
  const Scratch scratch;
  const app::Run run = run_of(
      scratch,
      "kinetix: 1\ntarget: {kind: display, rows: [\"000\", \"010\", \"000\"]}\nvariables: {offset_mm: 0}\n");
  ASSERT_TRUE(run.print);
  EXPECT_FALSE(run.print->is_accepted);
  EXPECT_THAT(run.print->why, ::testing::HasSubstr("the file does not describe how they are made"));
}

TEST(PrintableCells, OfANetBecomeLarger) {
  const Scratch scratch;
  const std::string net = "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 1]}\nprocess: sls\n";
  const app::Run run = run_of(scratch, net);
  EXPECT_TRUE(run.print->is_accepted) << run.print->why;
  EXPECT_TRUE(run.met());
  EXPECT_GE(size_of(run).edge_mm, 10);
}

/// Returns the goal of a text with other cells, as YAML, and whether the text itself gives one of its keys.
std::pair<std::string, bool> changed_keys(const std::string& text, const model::CellSize& before,
                                          const model::CellSize& size) {
  const Scratch scratch;
  const app::Target target = app::read_target(scratch.write("goal.yaml", text));
  const auto changed = target.goal->resize(before, size);
  return changed ? std::pair(changed->keys, changed->changes_given) : std::pair(std::string(), false);
}

TEST(PrintableCells, KeysOfLargerCellsKeepTheLengthThatAGoalGives) {
  const model::CellSize before{10, 1, 6}, larger{16, 1, 6};
  const std::string curve = rainbow, fold = "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 1]}\n",
                    outline =
                        "kinetix: 1\ntarget: {kind: outline, points: [[0, 0], [90, 0], [90, 90], [0, 90]]}\n";
  EXPECT_EQ(changed_keys(curve, before, larger),
            std::pair(std::string("structure: {cell_mm: 16, wall_mm: {thickness: 1, height: 6}}"), false));
  EXPECT_EQ(changed_keys(curve, before, {10, 1.2, 6}),
            std::pair(std::string("structure: {cell_mm: 10, wall_mm: {thickness: 1.2, height: 6}}"), false))
      << "other walls alone would change the number of cells";
  EXPECT_EQ(changed_keys(curve + "structure: {cells: [20, 1]}\n", before, larger),
            std::pair(std::string("structure: {cells: [12, 1], wall_mm: {thickness: 1, height: 6}}"), true));
  EXPECT_EQ(
      changed_keys(curve + "structure: {cells: [20, 1], cell_mm: 9}\n", before, larger),
      std::pair(std::string("structure: {cell_mm: 15, cells: [12, 1], wall_mm: {thickness: 1, height: 6}}"),
                true));
  EXPECT_EQ(changed_keys(fold, before, larger),
            std::pair(std::string("structure: {cell_mm: 16, wall_mm: {thickness: 1, height: 6}}"), false));
  EXPECT_EQ(
      changed_keys(fold + "structure: {cell_mm: 10, wall_mm: {thickness: 1, height: 6}}\n", before, larger),
      std::pair(std::string("structure: {cell_mm: 16}"), true));
  EXPECT_EQ(changed_keys(outline, before, larger),
            std::pair(std::string("structure: {cells: [7, 7], wall_mm: {thickness: 1, height: 6}}"), false));
}

constexpr const char* short_rainbow =
    "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [30, 12], [60, 16], [90, 12], [120, 0]]}\n"
    "structure: {cells: [8, 1], wall_mm: {thickness: 0.8, height: 6}}\n";

/// Returns the texts of the run's problems.
std::string problems_of(const app::Run& run) {
  std::string out;
  for (const app::Problem& problem : verdict_of(run).problems) out += problem.text + "\n";
  return out;
}

// The clip or strap that the search chose is in its design, and `export` makes it.
TEST(DefaultLock, IsAClipOrAStrapThatExportMakes) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, short_rainbow);
  ASSERT_TRUE(run.print && run.print->lock);
  ASSERT_TRUE(run.design.lock);
  EXPECT_EQ(run.print->lock->kind, to_string(*run.design.lock));
  EXPECT_THAT(problems_of(run), Not(HasSubstr("nothing holds the fold")));
  const auto lock = app::answer_of_export(app::written_design(run)).lock;
  ASSERT_TRUE(lock);
  EXPECT_EQ(lock->bodies, run.print->lock->bodies);
  EXPECT_EQ(app::result_json(run)["manufacture"]["lock"]["kind"], lock->kind);
}

TEST(DefaultLock, LeavesARequestedNoneAlone) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, short_rainbow + std::string("lock: none\n"));
  EXPECT_EQ(run.design.lock, app::LockKind::none);
  EXPECT_FALSE(run.print->lock);
  EXPECT_THAT(problems_of(run), Not(HasSubstr("nothing holds the fold")));
}

TEST(DefaultLock, IsNoneWithAWarningIfNothingFits) {
  const Scratch scratch;
  app::RunOptions options = printable_options();
  options.printable = [](const Design& design) {
    app::PrintAnswer answer = app::answer_of_export(design);
    answer.add_lock = [] { return std::optional<app::Lock>(); };
    return answer;
  };
  const app::Run run = run_goal(*app::read_target(scratch.write("goal.yaml", short_rainbow)).goal, options);
  EXPECT_EQ(run.design.lock, app::LockKind::none);
  EXPECT_THAT(problems_of(run), HasSubstr("nothing holds the fold: no clip or strap fits"));
  EXPECT_EQ(exit_code(verdict_of(run)), app::done);
}

// Posts would be in front of a picture, and a cut sheet has none.
TEST(DefaultLock, IsNoneForDisplaysAndCutSheets) {
  const Scratch scratch;
  for (const char* goal :
       {"target: {kind: display, rows: [\"00000\", \"01110\", \"01010\", \"01110\", \"00000\"]}\n",
        "target: {kind: outline, points: [[0, 0], [150, 0], [150, 150], [0, 150]]}\nprocess: laser\n"
        "structure: {cells: [4, 4], trim: none, cell_mm: 40, wall_mm: {thickness: 5}}\n"
        "variables: {t: {range: [0.3, 0.7]}, offset_mm: 2, theta: {range_deg: [10, 20]}}\n"}) {
    const app::Run run = run_of(scratch, std::string("kinetix: 1\n") + goal);
    EXPECT_EQ(run.design.lock, app::LockKind::none) << goal;
    EXPECT_THAT(problems_of(run), Not(HasSubstr("nothing holds the fold"))) << goal;
  }
}

/// Returns how a strip of two cells is folded. @param hinge section of the design
std::optional<Folding> folding_of_strip(const Scratch& scratch, const std::string& hinge) {
  return app::find_folding(app::read_design(scratch.write(
      "design.yaml",
      "kinetix: 1\nstructure: {cells: [2, 1], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}\n"
      "design: {theta_deg: 20}\n" +
          hinge)));
}

/// Returns the largest load of the equilibrium path of the last design with a drive.
double simulated_load(const Scratch& scratch, const Folding& folding) {
  Design design = app::read_design(scratch / "design.yaml");
  design.drive = folding.drive;
  const app::Run run = run_design(design, app::Model::equilibrium, {});
  EXPECT_TRUE(run.equilibrium->reached());
  return largest_load(run.equilibrium->path);
}

// Pins resist by their friction alone, 0.1 N mm/rad each. The elastic model has the same friction.
TEST(FindFolding, OfPinsIsTheFrictionOfAll) {
  const Scratch scratch;
  const auto free =
      folding_of_strip(scratch, "hinge: {model: rotary, kind: pin, diameter_mm: 3, clearance_mm: 0.3}\n");
  ASSERT_TRUE(free);
  EXPECT_TRUE(free->turns_freely);
  EXPECT_EQ(app::describe_effort(*free), "by hand");
  EXPECT_NEAR(simulated_load(scratch, *free), free->load, 0.01 * free->load);
  EXPECT_FALSE(folding_of_strip(scratch, "")) << "hinges left open have no force";
}

// Plates on leaning hinges need their largest force near flat, 14 % more than at the fold.
TEST(FindFolding, OfPinsIsTheLargestDuringTheMotion) {
  const Scratch scratch;
  const auto free = app::find_folding(app::read_design(scratch.write(
      "design.yaml",
      "kinetix: 1\nstructure: {cells: [2, 1], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}\n"
      "design:\n  theta_deg: 20\n  hinges: [{wall: [[0, 0], [1, 0]], tilt_deg: -50}, "
      "{wall: [[0, 1], [1, 1]], tilt_deg: 50}, {wall: [[1, 0], [2, 0]], tilt_deg: -50}, "
      "{wall: [[1, 1], [2, 1]], tilt_deg: 50}]\n"
      "hinge: {model: rotary, kind: pin, diameter_mm: 3, clearance_mm: 0.3}\n")));
  ASSERT_TRUE(free);
  EXPECT_NEAR(free->load, 0.2535, 0.01 * 0.2535);
  EXPECT_NEAR(simulated_load(scratch, *free), free->load, 0.01 * free->load);
}

// All 40 pins of a plane panel turn by 2 theta. Plates 80 mm apart close in to cos(theta) of that.
TEST(FindFolding, OfPinsInAPlaneIsTheClosedForm) {
  const Scratch scratch;
  const Design design = app::read_design(scratch.write(
      "design.yaml",
      "kinetix: 1\nstructure: {cells: [4, 4], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}\n"
      "design: {theta_deg: 20}\nhinge: {model: rotary, kind: pin, diameter_mm: 3, clearance_mm: 0.3}\n"));
  const double theta = design.theta;
  const auto free = app::find_folding(design);
  ASSERT_TRUE(free);
  constexpr double friction = 0.1, pins = 40;  // N mm/rad per pin
  const double energy_rate = pins * friction * 2 * theta * 2;
  const double expected = free->is_force ? energy_rate / (80 * std::sin(theta)) : energy_rate / 2;
  EXPECT_NEAR(free->load, expected, 1e-6 * expected);
}

// The drive of a stiff film holds the fold in the equilibrium path of `simulate`, with the same load.
TEST(FindFolding, OfSoftHingesIsTheLoadOfTheirEquilibrium) {
  const Scratch scratch;
  const std::string film = "hinge: {kind: film, material: pp, gap_mm: 2, thickness_mm: 0.4}\n";
  const auto folded = folding_of_strip(scratch, film);
  ASSERT_TRUE(folded);
  ASSERT_TRUE(folded->is_possible()) << folded->why_not;
  EXPECT_FALSE(folded->turns_freely);
  EXPECT_NEAR(simulated_load(scratch, *folded), folded->load, 0.01 * folded->load);
}

// Long strips of rubber lean between plates and follow no single hinge.
TEST(FindFolding, SaysThatNoDriveFoldsALongStripOfRubber) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, std::string(rainbow) +
                                           "structure: {cells: [12, 1], cell_mm: 12}\n"
                                           "hinge: {kind: block}\n");
  ASSERT_TRUE(run.folding);
  EXPECT_FALSE(run.folding->is_possible());
  EXPECT_THAT(run.folding->why_not, HasSubstr("no drive folds it"));
  EXPECT_EQ(app::describe_effort(*run.folding), "no");
  EXPECT_THAT(app::verdict_of(run).reasons(), HasSubstr("with `hinge: {kind: pin}`"));
  const app::Run advised = run_of(scratch, std::string(rainbow) +
                                               "structure: {cells: [12, 1], cell_mm: 12}\n"
                                               "hinge: {kind: pin}\n");
  EXPECT_TRUE(advised.met());
  EXPECT_EQ(exit_code(app::verdict_of(advised)), app::done);
}

// Cells grow until living hinges fit. No drive folds that sheet, and the advice is the same.
TEST(FindFolding, OfLivingHingesInLargerCellsNamesPins) {
  const Scratch scratch;
  const app::Run run = run_of(scratch,
                              "kinetix: 1\nprocess: sls\nhinge: {kind: film}\n"
                              "target: {kind: curve, points: [[0, 0], [20, 6], [40, 20], [50, 40], [45, 60], "
                              "[30, 70]]}\n");
  EXPECT_THAT(app::verdict_of(run).reasons(), HasSubstr("with `hinge: {kind: pin}`"));
}

// A panel of bridges is the equilibrium under its drive, which is not near the exact motion. Export follows that drive.
TEST(FindFolding, OfElasticHingesWithADriveIsThatOfTheSearch) {
  const Scratch scratch;
  const app::Run run = run_of(scratch,
                              "kinetix: 1\ntarget: {kind: display, glyph: L}\n"
                              "structure: {cells: [6, 6]}\nprocess: laser\n");
  ASSERT_TRUE(run.folding);
  const auto found = app::find_folding(app::written_design(run));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_possible()) << found->why_not;
  EXPECT_NEAR(found->load, run.folding->load, 1e-6 * run.folding->load);
  EXPECT_THAT(found->overstrain, HasSubstr("strained by"));
  EXPECT_THAT(app::verdict_of(run).reasons(), HasSubstr(found->overstrain));
}

// Springs fold a strip of rubber, also in an export of its design.
TEST(FindFolding, OfSpringsIsUnaided) {
  const Scratch scratch;
  const auto found = folding_of_strip(scratch,
                                      "hinge: {kind: block, material: tango, gap_mm: 3}\n"
                                      "drive: {kind: shape_memory, angle_deg: 40, k_turn: 5}\n");
  ASSERT_TRUE(found);
  EXPECT_EQ(app::describe_effort(*found), "unaided") << found->why_not;
}

// Large sheets of rubber are not followed. Nobody knows whether a drive folds them, and the verdict does not claim it.
TEST(FindFolding, OfALargeSheetOfRubberIsUnknown) {
  const Scratch scratch;
  const app::Run run =
      run_of(scratch,
             "kinetix: 1\n"
             "target: {kind: curve, points: [[0, 0], [90, 36], [180, 48], [270, 36], [360, 0]]}\n"
             "structure: {cells: [40, 4]}\nhinge: {kind: block}\n");
  const app::RunVerdict verdict = verdict_of(run);
  EXPECT_FALSE(run.folding);
  EXPECT_EQ(verdict.printable, true);
  EXPECT_FALSE(verdict.reaches);
  EXPECT_THAT(headline(verdict), HasSubstr("drive unknown"));
  EXPECT_EQ(exit_code(verdict), app::done);
}

// Plates cannot hold the net of a box, and other motions begin at flat. The drive that is named leads to the box, also in
// the elastic model, which does not know the exact motion.
TEST(FindFolding, OfANetOfPinsEndsAtItsExactMotion) {
  const Scratch scratch;
  const app::Run run = run_of(scratch, "kinetix: 1\ntarget: {kind: fold, box: [2, 2, 2]}\n");
  ASSERT_TRUE(run.folding);
  ASSERT_TRUE(run.folding->turns_freely);
  ASSERT_TRUE(run.folding->drive);
  EXPECT_FALSE(std::holds_alternative<model::Plates>(*run.folding->drive));
  const Design design = app::written_design(run);
  ASSERT_TRUE(design.drive);
  const app::Run driven = run_design(design, app::Model::equilibrium, {});
  ASSERT_TRUE(driven.equilibrium->reached());
  EXPECT_LT(aligned_distance(design.structure, driven.equilibrium->path.state, run.own).rms,
            0.1);  // cell edges
}

// A tendon that is shorter on the other side would fold the panel to that side.
TEST(FindFolding, OfAPanelOfPinsTriesDrivesThatEndAtItsTheta) {
  const Scratch scratch;
  const Design design = app::read_design(scratch.write(
      "design.yaml",
      "kinetix: 1\nstructure: {cells: [4, 2], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}\n"
      "design: {theta_deg: 20}\nhinge: {model: rotary, kind: pin, diameter_mm: 3, clearance_mm: "
      "0.3}\n"));
  const model::ExactMotion exact = exact_motion(design.structure);
  ASSERT_TRUE(exact);
  for (const model::TrialDrive& trial : trial_drives(design.structure, exact, design.theta))
    if (trial.drive)
      EXPECT_NEAR(exact.theta_of(*trial.drive), design.theta, 1e-6) << trial.name;
    else
      EXPECT_FALSE(trial.why_not.empty()) << trial.name;
}

TEST(FindFolding, PinsThatNoPushFoldsAreTurnedByHand) {
  const Folding by_turns{.name = "one hinge after the other", .turns_freely = true};
  EXPECT_TRUE(by_turns.is_by_turns());
  EXPECT_EQ(app::describe_effort(by_turns), "by hand");
  EXPECT_THAT(app::describe_folding(by_turns), HasSubstr("one hinge after the other"));
  EXPECT_TRUE(app::load_json(by_turns, true).is_null());
}

TEST(FindFolding, EffortsAreThoseOfAHandAndAClamp) {
  const auto effort = [](double load, bool is_force) {
    return app::describe_effort({.name = "plates", .load = load, .is_force = is_force});
  };
  EXPECT_EQ(effort(100, true), "by hand");
  EXPECT_EQ(effort(101, true), "with a clamp");
  EXPECT_EQ(effort(1001, true), "no");
  EXPECT_EQ(effort(NAN, true), "no");
  EXPECT_EQ(effort(3000, false), "by hand");
  EXPECT_EQ(effort(30000, false), "with a clamp");
  EXPECT_EQ(app::describe_effort({.name = "springs", .is_unaided = true}), "unaided");
}

}  // namespace
}  // namespace kinetix::testing
