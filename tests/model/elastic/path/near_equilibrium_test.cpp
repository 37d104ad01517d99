#include "model/elastic/path/near_equilibrium.hpp"

#include <gtest/gtest.h>

#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "tests/support/elastic_runs.hpp"
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
  EXPECT_EQ(path.why, "no closed form fits the structure");
}

}  // namespace
}  // namespace kinetix::model
