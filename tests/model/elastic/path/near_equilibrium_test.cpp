#include <gtest/gtest.h>
#include <algorithm>

#include "model/elastic/path/near_equilibrium.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using namespace testing;
using Stop = EquilibriumPath::Stop;

// rad: well away from flat, and from 45 deg, where walls close the cells.
constexpr double theta = 25 * radians_per_degree;

Structure bent(double tilt) {
  auto design = ExactDesign<double>::basic(6, 1);
  for (int c = 0; c < 6; c += 2) design.beta[c] = tilt;
  return structure_of(design);
}

Drive by_hinge(const Structure& structure) {
  return HingeTurn{*structure.hinge_at({{2, 0}, Axis::y}), -2 * theta};
}

TEST(NearEquilibrium, AtAClosedFormIsThatFormButForTheStiffnessRatio) {
  const Structure s = bent(0.4);
  const State exact = fold(classify(s), s, theta);
  double last = 1;
  for (const double k_turn : {1e-1, 1e-3}) {
    const EquilibriumPath path = equilibrium_at_closed_form(driven(s, by_hinge(s)), {.k_turn = k_turn});
    ASSERT_EQ(path.stop, Stop::reached) << path.why;
    const double rms = aligned_distance(s, path.state, exact).rms;
    EXPECT_LE(rms, last / 50);
    last = rms;
  }
}

/// The hinges of both ends keep the exact family, so that the closed form of the second is there to compare
/// with.
TEST(NearEquilibrium, OfChangedHingesIsTheSameAsFromTheirOwnClosedForm) {
  const Structure before = bent(0.4), after = bent(0.55);
  const Elasticity e{.k_turn = 1e-2};
  const EquilibriumPath start = equilibrium_at_closed_form(driven(before, by_hinge(before)), e);
  const EquilibriumPath changed =
      follow_change(start.state, changing(before, after, drive_on(after, by_hinge(after))), e);
  const EquilibriumPath own = equilibrium_at_closed_form(driven(after, by_hinge(after)), e);
  ASSERT_EQ(changed.stop, Stop::reached) << changed.why;
  ASSERT_EQ(own.stop, Stop::reached) << own.why;
  EXPECT_LE(aligned_distance(after, changed.state, own.state).rms, 1e-9);
  EXPECT_GE(aligned_distance(after, changed.state, start.state).rms, 1e-2);
  EXPECT_NEAR(changed.steps.back().energy, own.steps.back().energy, 1e-9 * own.steps.back().energy);
}

TEST(NearEquilibrium, SaysWhereThereIsNoClosedForm) {
  Structure s = bent(0.4);
  s.hinges[0].parameters.t = 0.4;
  const EquilibriumPath path = equilibrium_at_closed_form(driven(s, by_hinge(s)), {});
  EXPECT_EQ(path.stop, Stop::not_converged);
  EXPECT_EQ(path.why, "no analytic motion fits the structure");
}

using namespace testing;

LinkageDrive pressing(const Structure& sheet, Axis axis, double theta) {
  LinkageDrive drive = drive_on(sheet, plates_drive(axis, theta));
  drive.press = true;
  return drive;
}

EquilibriumPath path_of(const Structure& sheet, const LinkageDrive& drive) {
  return trace_equilibrium({sheet, drive, exact_motion(sheet)}, {}, without_contact());
}

double last_energy(const EquilibriumPath& path) { return path.steps.back().energy; }

/// The equilibrium has the least energy of all states whose rows stay between the plates. In it no plate pulls, and
/// none holds a body that is away from it.
TEST(PressedPath, PushesNoneThatIsAwayAndPullsNone) {
  for (const double k : {0.1, 0.15, 0.8}) {
    const Structure panel = letter_panel(k, 6);
    const LinkageDrive drive = pressing(panel, Axis::y, 0.35);
    const EquilibriumPath path = path_of(panel, drive);
    ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << path.why;
    const ElasticSystem system(panel, {}, drive, path.planar, false);
    const Eigen::VectorXd forces = system.elastic_gradient(path.state);
    const double L = panel.size.edge_mm, half = 3 * std::cos(0.35);
    double largest = 0;
    for (const int side : {0, 1})
      for (const int body : drive.gripped[side]) largest = std::max(largest, std::abs(forces[6 * body + 4]));
    int away = 0;
    for (const int side : {0, 1})
      for (const int body : drive.gripped[side]) {
        const double inward = side == 0 ? 1 : -1;
        const double by = inward * (path.state[body].p.y() / L - (3 - inward * half));
        const double force = inward * forces[6 * body + 4];
        EXPECT_GE(by, -1e-9);
        EXPECT_GE(force, -1e-6 * largest);
        EXPECT_LE(std::min(by, force / largest), 1e-6);
        away += by > 1e-3;
      }
    EXPECT_GE(away, 1) << k;

    LinkageDrive gripping = drive;
    gripping.press = false;
    EXPECT_LT(last_energy(path), last_energy(path_of(panel, gripping)));
  }
}

// Between the plates of a sheet that moves exactly nothing pulls hard, and the load is that of the closed form.
TEST(PressedPath, OfABasicSheetHasTheLoadOfItsClosedForm) {
  const Structure sheet = make_sheet(4, 5, {});
  const double theta = 0.4, height = 50, k_turn = Elasticity{}.k_turn;
  const EquilibriumPath path = path_of(sheet, pressing(sheet, Axis::y, theta));
  ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << path.why;
  EXPECT_LE(from_closed_form(sheet, path), 1e-4);
  const double moment = 4 * k_turn * theta * static_cast<double>(sheet.hinges.size());
  EXPECT_NEAR(path.steps.back().load, moment / (height * std::sin(theta)), 1e-3 * path.steps.back().load);
}

TEST(PressedPath, ShowsItsStatesOnceAndFromFlat) {
  const Structure panel = letter_panel(0.15, 6);
  std::vector<double> thetas;
  const EquilibriumPath path =
      trace_equilibrium({panel, pressing(panel, Axis::y, 0.35), exact_motion(panel)}, {}, without_contact(),
                        [&](const EquilibriumStep& step, const State&) { thetas.push_back(step.theta); });
  EXPECT_TRUE(std::is_sorted(thetas.begin(), thetas.end()));
  EXPECT_EQ(thetas.front(), 0);
  EXPECT_EQ(thetas.back(), path.theta);
}

}  // namespace
}  // namespace kinetix::model
