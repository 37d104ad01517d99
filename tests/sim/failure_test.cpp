#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <set>

#include "model/base/invalid_input.hpp"
#include "sim/physics_result.hpp"
#include "sim/physics_run.hpp"
#include "tests/sim/runs.hpp"

namespace kinetix::sim {
namespace {

using testing::curl;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::run;
using testing::strip;
using testing::structure_of;
using Status = PhysicsResult::Status;

// Four columns, tilts and theta in rad: quick, and all hinges move.
const auto bent = strip(curl(4, 0.3), 0.4);

TEST(FailedRun, NamesTheHingeThatIsOpenByMoreThanTheLimit) {
  PhysicsOptions options;
  options.gap_limit = 1e-30;
  const PhysicsResult result = run(bent, options);
  EXPECT_EQ(result.status, Status::hinge_gap_exceeded);
  EXPECT_THAT(result.why, HasSubstr("hinge on wall [["));
}

TEST(FailedRun, ReportsTheStrainOfADoublyCurvedPatch) {
  model::Structure patch = make_structure(model::rectangle(2, 2), {});
  for (model::Hinge& hinge : patch.hinges) {
    const auto [i, j] = hinge.wall.from;
    hinge.parameters.beta = ((hinge.wall.axis == model::Axis::x ? j : i) & 1) ? -0.5 : 0.5;
    if ((hinge.wall.axis == model::Axis::x ? i : j) & 1) hinge.parameters.beta *= -0.6;
  }
  ASSERT_EQ(classify(patch).family, model::Family::none);
  const PhysicsResult result = run_compression(patch, drive_on(patch, drive_to(patch, 0.4)));
  EXPECT_EQ(result.status, Status::hinge_gap_exceeded) << result.why;
  EXPECT_GT(result.gaps.max, 2e-3);
  EXPECT_LT(result.gaps.max, 0.1);
}

/// A 10 x 10 panel of basic cells with the letter T in cells of uniform scaling, k = 0.1.
model::Structure letter_panel() {
  model::Structure panel = make_structure(model::rectangle(10, 10), {});
  const auto in_letter = [](int i, int j) {
    const bool bar = j == 7 || j == 8, stem = i == 4 || i == 5;
    return (bar && i >= 1 && i <= 8) || (stem && j >= 1 && j <= 8);
  };
  for (model::Hinge& hinge : panel.hinges) {
    const auto [i, j] = hinge.wall.from;
    const bool along_x = hinge.wall.axis == model::Axis::x;
    if (in_letter(i, j) || in_letter(along_x ? i : i - 1, along_x ? j - 1 : j))
      hinge.parameters.t = fraction_from_lower(0.1, hinge.wall.from);
  }
  return panel;
}

TEST(FailedRun, FindsTheStrainOfALetterPanelThatTheEquilibriumModelFound) {
  const model::Structure panel = letter_panel();
  PhysicsOptions options;
  options.planar = true;
  options.contact = false;
  options.step_s = 1.0 / 300;
  const double theta = std::acos(0.84);
  EXPECT_EQ(run_compression(panel, drive_on(panel, drive_to(panel, theta)), options).status,
            Status::hinge_gap_exceeded);
  options.gap_limit = options.tear_limit = 1;
  for (const double sign : {1.0, -1.0}) {
    const PhysicsResult result =
        run_compression(panel, drive_on(panel, drive_to(panel, sign * theta)), options);
    EXPECT_EQ(result.status, Status::settled) << result.why;
    EXPECT_NEAR(result.gaps.rms, 0.047, 0.001);
  }
}

TEST(FailedRun, ReportsWhatBlowsUp) {
  PhysicsOptions options;
  options.speed_limit = 0.1;
  const PhysicsResult result = run(bent, options);
  EXPECT_EQ(result.status, Status::blew_up);
  EXPECT_EQ(result.steps, 0);
  EXPECT_THAT(result.why, HasSubstr("blew up"));
}

/// One part has no position, whichever it is, and no message prints it.
TEST(FailedRun, SaysInWordsThatThereIsNoStateToCompare) {
  const model::Structure structure = structure_of(bent);
  for (const std::size_t part : {std::size_t{0}, structure.bodies.size() - 1})
    for (const bool elastic : {false, true})
      for (const bool touching : {false, true}) {
        PhysicsOptions options;
        if (elastic) options.elastic = model::Stiffness{};
        PhysicsResult result;
        result.state = fold(bent, structure);
        result.state[part].p.x() = -std::nan("");
        result.gaps = hinge_gaps(structure, result.state);
        result.drive_gap = -std::nan("");
        if (touching) result.contact = {0, 1, 1e-3};
        set_status(structure, drive_on(structure, drive_to(structure, 0.4)), options, false, result);
        EXPECT_EQ(result.status, Status::blew_up) << result.why;
        EXPECT_THAT(result.why, HasSubstr("no state to compare"));
        EXPECT_THAT(result.why, Not(HasSubstr("nan")));
      }
}

TEST(FailedRun, NoticesWhatBlowsUpInTheLastStep) {
  PhysicsOptions options;
  options.drive_seconds = options.step_s;
  options.settle_seconds = 0;
  options.tear_limit = options.gap_limit = options.overlap_limit = 1e9;
  options.contact = false;
  options.speed_limit = 1000;
  model::Structure rigid = make_structure(model::rectangle(1, 40), {});
  for (model::Hinge& hinge : rigid.hinges) hinge.parameters.alpha = 1;
  const PhysicsResult result = run_compression(rigid, drive_on(rigid, drive_to(rigid, 0.4)), options);
  EXPECT_EQ(result.steps, 1);
  EXPECT_EQ(result.status, Status::blew_up) << result.why;
}

TEST(FailedRun, DoesNotPassOffAnAbsurdDriveAsSettled) {
  PhysicsOptions options;
  options.step_s = 0.1;
  options.drive_seconds = 0.1;
  const PhysicsResult result = run(bent, options);
  EXPECT_NE(result.status, Status::settled);
  EXPECT_FALSE(result.why.empty());
}

TEST(FailedRun, ReportsAStripThatHasNoTimeToSettle) {
  PhysicsOptions options;
  options.settle_seconds = 0;
  const PhysicsResult result = run(bent, options);
  EXPECT_EQ(result.status, Status::not_settled);
  EXPECT_THAT(result.why, HasSubstr("not at rest"));
}

TEST(FailedRun, NoticesTheOtherSignOfTheta) {
  const auto design = strip(curl(24, 0.12), 0.5);
  const model::Structure structure = structure_of(design);
  const model::Drive drive = drive_to(structure, 0.5);
  for (const double theta : {0.5, -0.5}) {
    auto reached = design;
    reached.theta = theta;
    PhysicsResult result;
    result.state = fold(reached, structure);
    result.gaps = hinge_gaps(structure, result.state);
    set_status(structure, drive_on(structure, drive), {}, true, result);
    EXPECT_EQ(result.status, theta > 0 ? Status::settled : Status::wrong_branch) << result.why;
  }
}

TEST(FailedRun, DoesNotHappenToALongStripOfSteepTiltsThatCurlsUp) {
  const auto spiral = strip(curl(60, 0.3), 0.5);
  PhysicsOptions options;
  options.contact = false;
  const PhysicsResult result = run(spiral, options);
  EXPECT_EQ(result.status, Status::settled) << result.why;
  const model::Structure structure = structure_of(spiral);
  EXPECT_LE(aligned_distance(structure, result.state, fold(spiral, structure)).rms, 1e-5);
}

TEST(PhysicsOptions, RejectNanAndWhatIsOutOfRange) {
  const auto rejects = [](auto PhysicsOptions::*field, auto value, const char* name) {
    PhysicsOptions options;
    options.*field = value;
    try {
      options.validate();
      ADD_FAILURE() << name << " = " << value << " was accepted";
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
  };
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -1.0, 0.0}) {
    rejects(&PhysicsOptions::step_s, bad, "step_s");
    rejects(&PhysicsOptions::reach, bad, "reach");
    rejects(&PhysicsOptions::part_inertia, bad, "part_inertia");
    rejects(&PhysicsOptions::drive_seconds, bad, "drive_seconds");
    rejects(&PhysicsOptions::joint_stiffness, bad, "joint_stiffness");
    rejects(&PhysicsOptions::settle_speed, bad, "settle_speed");
    rejects(&PhysicsOptions::gap_limit, bad, "gap_limit");
    rejects(&PhysicsOptions::tear_limit, bad, "tear_limit");
    rejects(&PhysicsOptions::overlap_limit, bad, "overlap_limit");
    rejects(&PhysicsOptions::speed_limit, bad, "speed_limit");
  }
  for (const double bad : {nan, infinite, -1.0}) {
    rejects(&PhysicsOptions::settle_seconds, bad, "settle_seconds");
    rejects(&PhysicsOptions::settle_damping, bad, "settle_damping");
  }
  rejects(&PhysicsOptions::step_s, 1e-12, "step_s");
}

TEST(Drive, RejectsWhatCannotBeDriven) {
  const model::Structure structure = structure_of(bent);
  const auto rejected = [&](const model::Drive& drive) {
    EXPECT_THROW(run_compression(structure, drive_on(structure, drive)), InvalidInput);
  };
  for (const double bad : {std::nan(""), -0.1, 1.0}) rejected(model::Plates{.compression = bad});
  rejected(model::Plates{.branch = 0});
  EXPECT_THROW(hinge_drive_to(structure, {{9, 9}, model::Axis::x}, 0), InvalidInput);
  for (const double bad : {std::nan(""), pi, -4.0}) rejected(model::HingeTurn{0, bad});
  EXPECT_THROW(drive_to(structure, pi / 2), InvalidInput);
  EXPECT_THROW(drive_to(structure, std::nan("")), InvalidInput);
}

TEST(Drive, KeepsSmallThetasToTheLastDigits) {
  const model::Structure structure = structure_of(bent);
  for (const double theta : {1.5, 0.3, 1e-3, 1e-6, 1e-9, 0.0}) {
    EXPECT_NEAR(drive_on(structure, drive_to(structure, theta)).theta(), theta, 1e-14 * theta);
    EXPECT_NEAR(drive_on(structure, drive_to(structure, -theta)).theta(), -theta, 1e-14 * theta);
  }
}

TEST(PhysicsResult, EveryStatusHasItsOwnWords) {
  std::set<std::string> words;
  for (const Status status : {Status::settled, Status::not_settled, Status::hinge_gap_exceeded,
                              Status::drive_missed, Status::wrong_branch, Status::blocked, Status::blew_up})
    words.insert(to_string(status));
  EXPECT_EQ(words, (std::set<std::string>{"settled", "not settled", "hinge gap exceeded", "drive missed",
                                          "wrong branch", "blocked", "blew up"}));
}

}  // namespace
}  // namespace kinetix::sim
