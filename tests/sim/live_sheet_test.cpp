#include "sim/live_sheet.hpp"

#include <random>

#include "model/closure/closure.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/elastic_system.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "tests/sim/runs.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using sim::LiveSheet;

constexpr double step_s = 1.0 / 240;  // of the studio

sim::PhysicsOptions live(bool elastic = false) {
  sim::PhysicsOptions options;
  options.step_s = step_s;
  if (elastic) options.elastic = model::Stiffness{};
  return options;
}

/// Returns how far a state is from its family's state at the same mean theta, cell edges.
double off_family(const model::Structure& structure, const model::State& state) {
  const double theta = mean_theta(structure, state);
  return aligned_distance(structure, state, exact_motion(structure).at(theta)).max;
}

/// Returns the state moved as one rigid body, so that body 0 is as at rest.
model::State moved_to_start(const model::State& state) {
  const Eigen::Matrix3d back = state[0].R.transpose();
  return moved(state, {back, -back * state[0].p});
}

void run(LiveSheet& sheet, double seconds) {
  for (int k = 0; k < seconds / step_s; ++k) sheet.step();
}

TEST(LiveSheet, FollowsTheHandAlongItsFamily) {
  const model::Structure structure = structure_of(strip(curl(12, 0.4), 0));
  const model::Linkage linkage = structure;
  LiveSheet sheet(linkage, live(), 1000);
  const int last = static_cast<int>(linkage.bodies.size()) - 1;
  const model::State folded = moved_to_start(exact_motion(structure).at(0.5));
  const Vector3d from = linkage.rest_position(last), to = folded[last].p;
  sheet.fix(0, true);
  sheet.drag(last, from, to);
  run(sheet, 3);
  EXPECT_LT((sheet.state()[last].p - to).norm(), 0.02 * (from - to).norm());
  EXPECT_NEAR(mean_theta(linkage, sheet.state()), 0.5, 0.02);
  EXPECT_LT(sheet.state()[0].p.norm(), 0.1);
  sheet.release();
  run(sheet, 2);
  EXPECT_LT(off_family(structure, sheet.state()), 1e-3);
}

/// Drags a strip about at random, and checks that it gains no energy and returns to its family.
void expect_no_energy_from_drags(unsigned sheets) {
  const model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  const model::Linkage linkage = structure;
  for (unsigned seed = 0; seed < sheets; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-60, 60);
    LiveSheet sheet(linkage, live(), 1000);
    for (int drag = 0; drag < 8; ++drag) {
      const int body = static_cast<int>(random() % linkage.bodies.size());
      sheet.drag(body, linkage.rest_position(body), {place(random), place(random), place(random)});
      run(sheet, 0.4);
      ASSERT_TRUE(is_finite(sheet.state()));
      sheet.release();
      double energy = sheet.energy();
      for (int k = 0; k < 40; ++k) {
        sheet.step();
        ASSERT_LE(sheet.energy(), energy * (1 + 1e-9));
        energy = sheet.energy();
      }
    }
    run(sheet, 2);
    EXPECT_LT(off_family(structure, sheet.state()), 1e-3);
  }
}

TEST(LiveSheet, KeepsItsHeadWhateverHandsDo) { expect_no_energy_from_drags(3); }

TEST(LiveSheetSoak, KeepsItsHeadWhateverHandsDo) { expect_no_energy_from_drags(10); }

TEST(LiveSheet, SpringsBackToFlatWithoutGainingEnergy) {
  const model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  const model::Linkage linkage = structure;
  sim::PhysicsOptions options = live(true);
  options.elastic->turn = 1e-3;
  LiveSheet sheet(linkage, options, 1);
  sheet.place(exact_motion(structure).at(0.6));
  double energy = sheet.energy();
  EXPECT_GT(sheet.hinge_energy_Nmm(), 0.1);
  for (int k = 0; k < 5 / step_s; ++k) {
    sheet.step();
    ASSERT_LE(sheet.energy(), energy * (1 + 1e-9));
    energy = sheet.energy();
  }
  EXPECT_LT(std::abs(mean_theta(linkage, sheet.state())), 1e-2);
}

TEST(LiveSheet, SaysTheEnergyOfTheElasticModel) {
  const model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  const model::Linkage linkage = structure;
  const model::Elasticity elasticity{.k_point = 700, .k_turn = 20, .reach_mm = 3};
  sim::PhysicsOptions options = live(true);
  options.elastic = relative(elasticity, linkage.size.edge_mm);
  std::mt19937 random(7);
  const model::State state = shaken(structure, exact_motion(structure).at(0.4), 0.02, random);
  LiveSheet sheet(linkage, options, elasticity.k_point);
  sheet.place(state);
  const model::ElasticSystem system(linkage, elasticity, false, false);
  const double expected = energy_unit(elasticity, linkage.size.edge_mm) * system.elastic_energy(state);
  EXPECT_NEAR(sheet.hinge_energy_Nmm(), expected, 1e-9 * expected);
}

// A hand moves the strip, at rest, a short way. Its work is what the hinges store.
TEST(LiveSheet, SaysTheForceOfTheHandThatTheEnergyAsksFor) {
  const model::Structure structure = structure_of(strip(curl(4, 0.4), 0));
  const model::Linkage linkage = structure;
  const model::Elasticity elasticity{.k_point = 700, .k_turn = 20, .reach_mm = 3};
  sim::PhysicsOptions options = live(true);
  options.elastic = relative(elasticity, linkage.size.edge_mm);
  LiveSheet sheet(linkage, options, elasticity.k_point);
  const int last = static_cast<int>(linkage.bodies.size()) - 1;
  const Vector3d from = linkage.rest_position(last);
  sheet.fix(0, true);
  struct Held {
    Vector3d way, force;
    double energy;
  };
  const auto held_at = [&](double theta) {
    const Vector3d to = moved_to_start(exact_motion(structure).at(theta))[last].p;
    sheet.drag(last, from, to);
    run(sheet, 4);
    const Vector3d at = sheet.state()[last].p;
    return Held{at - sheet.state()[0].p, sheet.pull_force_N() * (to - at).normalized(),
                sheet.hinge_energy_Nmm()};
  };
  const Held near = held_at(0.3), far = held_at(0.33);
  const double work = (near.force + far.force).dot(far.way - near.way) / 2;
  EXPECT_GT(far.energy, 1.05 * near.energy);
  EXPECT_NEAR(work / (far.energy - near.energy), 1, 0.02);
  sheet.release();
  EXPECT_TRUE(std::isnan(sheet.pull_force_N())) << "no hand";
}

// Plates close in on the middle of the flat sheet, wherever it is when they grip it.
TEST(LiveSheet, PlatesTakeItToTheMiddleBetweenThem) {
  const model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  const model::Linkage linkage = structure;
  const model::ExactMotion exact = exact_motion(structure);
  for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
    const int along = axis == model::Axis::x ? 0 : 1;
    const model::LinkageDrive drive = drive_on(structure, plates_drive(axis, 0.6));
    LiveSheet sheet(linkage, live(), 1000);
    sheet.place(moved(exact.at(0.3), {Eigen::Matrix3d::Identity(), Vector3d(3, -5, 8)}));
    sheet.drive_to(drive, exact.at(0.3));
    Vector3d off = Vector3d::Zero();
    for (const std::vector<int>& row : drive.gripped) {
      const int middle = row[row.size() / 2];
      off += 0.5 * (sheet.state()[middle].p - linkage.rest_position(middle));
    }
    EXPECT_NEAR(off[along], 0, 1e-9) << along;
    EXPECT_NEAR(off.z(), 0, 1e-9) << along;
  }
}

TEST(LiveSheet, IsDrivenToTheFoldFromAnywhere) {
  const model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  const model::Linkage linkage = structure;
  const model::ExactMotion exact = exact_motion(structure);
  LiveSheet sheet(linkage, live(), 1000);
  sheet.place(exact.at(0.3));
  sheet.drive_to(drive_on(structure, drive_to(structure, 0.6)), exact.at(0.3));
  run(sheet, 1.5);
  EXPECT_NEAR(mean_theta(linkage, sheet.state()), 0.6, 1e-3);
  EXPECT_LT(off_family(structure, sheet.state()), 1e-3);
}

/// An arch of eight cells.
struct Arch {
  model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  model::Linkage linkage = structure;
};

TEST(LiveSheet, TurnsOneHingeAsItsDriveSays) {
  const Arch arch;
  model::LinkageDrive drive;
  drive.kind = model::LinkageDrive::Kind::hinge;
  drive.hinge = *arch.structure.hinge_at({{4, 0}, model::Axis::y});
  drive.sense = arch.linkage.bodies[arch.linkage.hinges[drive.hinge].lower].sense;
  LiveSheet sheet(arch.linkage, live(), 1000);
  sheet.place(exact_motion(arch.structure).at(0.2));
  sheet.drive_to(drive.to(0.4), sheet.state());
  run(sheet, 4);
  EXPECT_NEAR(hinge_turn(arch.linkage, sheet.state(), drive.hinge), drive.to(0.4).angle, 1e-3);
  EXPECT_LT(off_family(arch.structure, sheet.state()), 1e-3);
}

TEST(LiveSheet, ACordPullsAndDoesNotPush) {
  const Arch arch;
  const std::vector<int> through = {*arch.structure.hinge_at({{0, 0}, model::Axis::y}),
                                    *arch.structure.hinge_at({{8, 0}, model::Axis::y})};
  const model::LinkageDrive drive = model::cord_drive(arch.linkage, through, 15);
  LiveSheet sheet(arch.linkage, live(), 1000);
  sheet.drive_to(drive, sheet.state());
  run(sheet, 2);
  const double beyond = drive.rest_mm - 15 - cord_length(arch.linkage, through, sheet.state());
  EXPECT_GT(beyond, -0.05) << "mm";
  EXPECT_LT(beyond, 1) << "mm: what it coasts while nothing holds it back";
  EXPECT_LT(off_family(arch.structure, sheet.state()), 1e-3);
  const double folded = mean_theta(arch.linkage, sheet.state());
  sheet.drive_to(drive.to(0), sheet.state());
  run(sheet, 2);
  EXPECT_NEAR(mean_theta(arch.linkage, sheet.state()), folded, 0.05) << "a slack cord leaves it as it is";
}

/// The springs fold the sheet as far as the hinges yield: to the rest state of both together.
TEST(LiveSheet, SpringsOfShapeMemoryFoldIt) {
  const model::Structure structure = structure_of(strip(std::vector<double>(8, 0.0), 0));
  const model::Linkage linkage = structure;
  sim::PhysicsOptions options = live(true);
  options.elastic->turn = 1e-3;
  options.spring_turn = 3e-3;
  LiveSheet sheet(linkage, options, 1);
  sheet.drive_to(model::shape_memory_drive(linkage, {}, 1, 2 * 0.6), sheet.state());
  run(sheet, 10);
  EXPECT_NEAR(mean_theta(linkage, sheet.state()), 0.6 * 3 / 4, 5e-3);
}

}  // namespace
}  // namespace kinetix::testing
