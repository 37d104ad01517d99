#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "sim/physics_run.hpp"
#include "tests/sim/elastic_equilibrium.hpp"
#include "tests/sim/runs.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::sim {
namespace {

using testing::curl;
using testing::elastic_energy;
using testing::imbalance;
using testing::letter_panel;
using testing::strip;
using testing::structure_of;
using Status = PhysicsResult::Status;

PhysicsOptions elastic(double turn) {
  PhysicsOptions options = testing::physics_without_contact();
  options.elastic = model::Stiffness{.turn = turn};
  return options;
}

model::Drive turn_of_wall(const model::Structure& structure, const model::Wall& wall, double angle) {
  return model::HingeTurn{*structure.hinge_at(wall), angle};
}

/// Runs the simulation, and checks that it settles with the forces of the hinges in balance.
PhysicsResult settled(const model::Structure& structure, const model::Drive& drive,
                      const PhysicsOptions& options) {
  const PhysicsResult result = run_compression(structure, drive_on(structure, drive), options);
  EXPECT_EQ(result.status, Status::settled) << result.why;
  EXPECT_LE(imbalance(structure, drive, result.state, *options.elastic, options.planar), 1e-6);
  return result;
}

TEST(ElasticRun, FoldsAnExactStripBetweenPlatesAsRigidHingesDo) {
  for (const double theta : {0.5, -0.5}) {
    const auto design = strip({0.5, 0, 0.5, 0, 0.5, 0}, theta);
    const model::Structure structure = structure_of(design);
    const model::State exact = fold(design, structure);
    const PhysicsOptions options = elastic(1e-6);
    const PhysicsResult result = settled(structure, drive_to(structure, theta), options);
    EXPECT_LE(aligned_distance(structure, result.state, exact).max, 1e-4);
    const double energy = elastic_energy(structure, result.state, *options.elastic);
    const double rigid = elastic_energy(structure, exact, *options.elastic);
    EXPECT_LT(energy, rigid);
    EXPECT_NEAR(energy, rigid, 1e-4 * rigid);
  }
}

/// Without time to watch the parts, a run cannot know whether they still move.
TEST(ElasticRun, IsNotSettledByStayingInPlaceForNoTime) {
  const auto design = strip({0.5, 0, 0.5, 0, 0.5, 0}, 0.5);
  const model::Structure structure = structure_of(design);
  PhysicsOptions options = elastic(1e-6);
  options.settle_residual_motion = 0.1;
  for (const double seconds : {0.0, 99 * options.step_s}) {
    options.settle_seconds = seconds;
    options.settle_force = 1e-300;  // never at rest by its forces
    const PhysicsResult result =
        run_compression(structure, drive_on(structure, drive_to(structure, 0.5)), options);
    EXPECT_EQ(result.status, Status::not_settled) << result.why;
  }
}

/// Parts that moved during the last watched steps are at rest at the end.
TEST(ElasticRun, LeavesNoMotionWhereItComesToRestJustBeforeTheTimeIsUp) {
  const auto design = strip({0.5, 0, 0.5, 0, 0.5, 0}, 0.5);
  const model::Structure structure = structure_of(design);
  PhysicsOptions options = elastic(1e-6);
  const PhysicsResult early =
      run_compression(structure, drive_on(structure, drive_to(structure, 0.5)), options);
  ASSERT_EQ(early.status, Status::settled) << early.why;
  options.settle_residual_motion = 0.1;
  options.settle_seconds = std::max(early.simulated_s - options.drive_seconds, 100 * options.step_s);
  const PhysicsResult late =
      run_compression(structure, drive_on(structure, drive_to(structure, 0.5)), options);
  EXPECT_EQ(late.status, Status::settled) << late.why;
  EXPECT_EQ(late.steps, early.steps);
  EXPECT_EQ(late.residual_motion, 0);
}

TEST(ElasticRun, ComesToTheExactFoldFromOneHingeAsTheTurningSpringsSoften) {
  const auto design = strip({0.5, 0, 0.5, 0, 0.5, 0}, 0.5);
  const model::Structure structure = structure_of(design);
  const model::Drive drive = turn_of_wall(structure, {{0, 0}, model::Axis::y}, -1);
  double before = 0;
  for (const double turn : {1e-6, 1e-7, 1e-8}) {
    const PhysicsResult result = settled(structure, drive, elastic(turn));
    const double distance = aligned_distance(structure, result.state, fold(design, structure)).max;
    EXPECT_LE(distance, 2e3 * turn);
    if (before > 0) {
      EXPECT_NEAR(distance / before, 0.1, 0.01);
    }
    before = distance;
  }
}

/// Past the largest load, linearised steps overshoot the equilibrium by more than they began before it.
TEST(ElasticRun, ComesToRestWhereStepsLeadPastTheEquilibrium) {
  const model::Structure structure = structure_of(model::ExactDesign<double>::basic(1, 2));
  PhysicsOptions options = testing::physics_without_contact();
  const double edge_mm = structure.size.edge_mm;
  options.elastic = model::relative(
      model::elasticity_of({.axial = 6.595, .shear = 1.646, .along = 3.812, .turn = 1.725}, 0.108 * edge_mm),
      edge_mm);
  options.planar = true;
  options.disturbance = 0.3;
  for (const double degrees : {60.0, 74.7, 80.0, 88.0}) {
    const model::LinkageDrive drive =
        drive_on(structure, turn_of_wall(structure, {{0, 0}, model::Axis::y}, degrees * radians_per_degree));
    options.disturbance_seed = 1;
    const PhysicsResult one = run_compression(structure, drive, options);
    options.disturbance_seed = 13;
    const PhysicsResult other = run_compression(structure, drive, options);
    EXPECT_EQ(one.status, Status::settled) << degrees << ": " << one.why;
    EXPECT_EQ(other.status, Status::settled) << degrees << ": " << other.why;
    EXPECT_LE(aligned_distance(structure, one.state, other.state).max, 1e-5) << degrees;
  }
}

TEST(ElasticRun, TakesALongStripOfStiffTurningSpringsToTheBranchOfItsDrive) {
  for (const double turn : {1e-6, 1e-4})
    for (const double theta : {0.3, -0.3}) {
      const model::Structure structure = structure_of(strip(curl(20, 0.16), theta));
      settled(structure, drive_to(structure, theta), elastic(turn));
    }
}

/// With c the compression, y-walls are pressed by 1 - c - cos(theta), and all four hinges turn by 2 theta:
/// E = 2 (cos(theta) - 1 + c)^2 + 8 turn theta^2.
TEST(ElasticRun, EquilibriaTheTurningSpringsOfOneCellAgainstItsPoints) {
  const model::Structure cell = make_structure(model::rectangle(1, 1), {});
  for (const double turn : {1e-4, 1e-3, 5e-3})
    for (const int branch : {1, -1}) {
      PhysicsOptions options = elastic(turn);
      options.planar = true;
      model::Plates drive;
      drive.compression = 0.1;
      drive.branch = branch;
      const PhysicsResult result = settled(cell, drive, options);
      const double theta = std::asin(result.state[0].R(1, 0));
      EXPECT_GT(branch * theta, 0.1);
      EXPECT_NEAR(std::cos(theta), 0.9 + 4 * turn * theta / std::sin(theta), 1e-5);
    }
}

/// With c the compression, E = 2 axial (cos(theta) - 1 + c)^2 + 8 turn theta^2: only the stiffness along the wall
/// counts.
TEST(ElasticRun, PressesTheWallsOfOneCellByTheirAxialStiffness) {
  const model::Structure cell = make_structure(model::rectangle(1, 1), {});
  for (const double axial : {1.0, 0.5, 0.2}) {
    PhysicsOptions options = elastic(1e-3);
    options.elastic->ratios = {axial, 0.4, 0.7};
    options.planar = true;
    model::Plates drive;
    drive.compression = 0.1;
    const PhysicsResult result = run_compression(cell, drive_on(cell, drive), options);
    ASSERT_EQ(result.status, Status::settled) << result.why;
    const double theta = std::asin(result.state[0].R(1, 0));
    EXPECT_NEAR(std::cos(theta), 0.9 + 4 * 1e-3 / axial * theta / std::sin(theta), 1e-5);
  }
}

TEST(ElasticRun, LeavesACellStraightThatIsPressedTooLittleToBuckle) {
  const model::Structure cell = make_structure(model::rectangle(1, 1), {});
  PhysicsOptions options = elastic(5e-3);
  options.planar = true;
  model::Plates drive;
  drive.compression = 0.01;
  const PhysicsResult result = settled(cell, drive, options);
  EXPECT_NEAR(elastic_energy(cell, result.state, *options.elastic), 2 * 0.01 * 0.01, 2e-7);
}

model::Structure twist_unit(double alpha_deg) {
  const double alpha = alpha_deg * radians_per_degree;
  const model::CellTuple tuple{.A_in = {pi / 2, alpha, pi / 2, alpha}};
  model::Structure unit = make_structure(model::rectangle(1, 1), {});
  apply_pattern(unit, tuple, tuple, model::SharedWalls::must_agree);
  return unit;
}

TEST(ElasticRun, HoldsATwistUnitInEquilibriumOnItsWayOverTheBarrier) {
  for (const double alpha_deg : {75.0, 60.0, 45.0})
    for (const double angle : {0.3, -0.3, 1.0, 1.4})
      for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
        SCOPED_TRACE(std::to_string(alpha_deg) + " deg, " + std::to_string(angle) + " rad");
        const model::Structure unit = twist_unit(alpha_deg);
        const PhysicsResult result = settled(unit, turn_of_wall(unit, {{0, 0}, axis}, angle), elastic(1e-6));
        EXPECT_GT(result.gaps.axis_max, 5e-3);
        EXPECT_LE(result.drive_gap, 2e-6);
      }
}

TEST(ElasticRun, StretchesTheHingesOfADoublyCurvedPatch) {
  for (const int cells : {2, 3}) {
    model::Structure patch = make_structure(model::rectangle(cells, cells), {});
    for (model::Hinge& hinge : patch.hinges) {
      const auto [i, j] = hinge.wall.from;
      const bool along_x = hinge.wall.axis == model::Axis::x;
      hinge.parameters.beta = ((along_x ? j : i) & 1) ? -0.5 : 0.5;
      if ((along_x ? i : j) & 1) hinge.parameters.beta *= -0.6;
    }
    const PhysicsResult result = settled(patch, drive_to(patch, 0.4), elastic(1e-6));
    EXPECT_NEAR(result.gaps.max, 0.013, 0.002);
  }
}

TEST(ElasticRun, SettlesInTheSameStateWhateverTheStepAndTheMassesAre) {
  const model::Structure panel = letter_panel(0.1, 6);
  PhysicsOptions options = elastic(1e-6);
  options.planar = true;
  const model::Drive drive = drive_to(panel, std::acos(0.84));
  const PhysicsResult reference = settled(panel, drive, options);
  options.step_s = 1.0 / 300;
  options.part_inertia = 0.3;
  const PhysicsResult other = settled(panel, drive, options);
  EXPECT_LE(aligned_distance(panel, other.state, reference.state).max, 1e-6);
}

TEST(ElasticRun, SettlesWhereWallsTouchInThePlane) {
  const model::Structure sheet = make_structure(model::rectangle(3, 3), {});
  PhysicsOptions options = elastic(1e-6);
  options.planar = options.contact = true;
  const PhysicsResult result = run_compression(sheet, drive_on(sheet, drive_to(sheet, 0.76)), options);
  EXPECT_EQ(result.status, Status::settled) << result.why;
  EXPECT_TRUE(result.contact.touches());
  EXPECT_GT(result.gaps.max, options.gap_limit);
}

TEST(ElasticRun, EndsWhereAHingeStretchesTooFar) {
  PhysicsOptions options = elastic(1e-6);
  options.planar = true;
  options.stretch_limit = 0.05;
  const model::Structure panel = letter_panel(0.15);
  const PhysicsResult result = run_compression(panel, drive_on(panel, drive_to(panel, 0.5)), options);
  EXPECT_EQ(result.status, Status::hinge_gap_exceeded);
  EXPECT_THAT(result.why, ::testing::HasSubstr("at most 0.05 is allowed"));
}

TEST(ElasticRun, RefusesSweepsAndWhatIsNotAStiffness) {
  const auto rejects = [](auto change, const char* name) {
    PhysicsOptions options = elastic(1e-6);
    change(options);
    try {
      options.validate();
      ADD_FAILURE() << name << " was accepted";
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(name));
    }
  };
  for (const double bad : {std::nan(""), -1e-9, 0.11})
    rejects([&](PhysicsOptions& o) { o.settle_residual_motion = bad; }, "settle_unrest");
  for (const double bad : {std::nan(""), 0.0, -1.0}) {
    rejects([&](PhysicsOptions& o) { o.elastic->turn = bad; }, "elastic.turn");
    rejects([&](PhysicsOptions& o) { o.elastic->reach = bad; }, "elastic.reach");
    rejects([&](PhysicsOptions& o) { o.elastic->contact = bad; }, "elastic.contact");
    rejects([&](PhysicsOptions& o) { o.elastic->ratios.axial = bad; }, "elastic.ratios.axial");
    rejects([&](PhysicsOptions& o) { o.elastic->ratios.shear = bad; }, "elastic.ratios.shear");
    rejects([&](PhysicsOptions& o) { o.elastic->ratios.along = bad; }, "elastic.ratios.along");
    rejects([&](PhysicsOptions& o) { o.settle_force = bad; }, "settle_force");
    rejects([&](PhysicsOptions& o) { o.stretch_limit = bad; }, "stretch_limit");
  }
}

}  // namespace
}  // namespace kinetix::sim
