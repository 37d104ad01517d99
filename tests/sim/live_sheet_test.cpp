#include "sim/live_sheet.hpp"

#include <random>

#include "model/closure/drive_theta.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "tests/sim/runs.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using sim::LiveSheet;

constexpr double step_s = 1.0 / 240;  // of the studio

sim::PhysicsOptions live(bool elastic = false) {
  sim::PhysicsOptions options;
  options.step_s = step_s;
  options.iterations = 20;
  if (elastic) options.elastic = model::Stiffness{};
  return options;
}

/// How far a state is from the family's state of its own theta, cell edges.
double off_family(const model::Structure& structure, const model::State& state) {
  const double theta = mean_theta(structure, state);
  return aligned_distance(structure, state, exact_motion(structure).at(theta)).max;
}

/// As one, so that body 0 stands as at rest.
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

TEST(LiveSheet, KeepsItsHeadWhateverHandsDo) {
  const model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  const model::Linkage linkage = structure;
  for (unsigned seed = 0; seed < 10; ++seed) {
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

TEST(LiveSheet, IsDrivenToTheFoldFromAnywhere) {
  const model::Structure structure = structure_of(strip(curl(8, 0.5), 0));
  const model::Linkage linkage = structure;
  const model::ExactMotion exact = exact_motion(structure);
  LiveSheet sheet(linkage, live(), 1000);
  sheet.place(exact.at(0.3));
  sheet.drive_to(drive_to(structure, 0.6).on(structure), exact.at(0.3));
  run(sheet, 1.5);
  EXPECT_NEAR(mean_theta(linkage, sheet.state()), 0.6, 1e-3);
  EXPECT_LT(off_family(structure, sheet.state()), 1e-3);
}

}  // namespace
}  // namespace kinetix::testing
