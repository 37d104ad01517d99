#include <gtest/gtest.h>

#include "model/elastic/newton.hpp"
#include "model/elastic/path/closed_form.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"

/// Tests of strips that press on the plates between which they fold. Only the middle of a strip is keyed upright. From
/// a certain length on, it tips over there by a twist along the strip instead of folding further.
namespace kinetix::model {
namespace {

using namespace testing;
using Kind = PathEvent::Kind;

bool folds(const Structure& s, double theta, const Elasticity& elasticity) {
  const ExactMotion exact = exact_motion(s);
  ElasticSystem system(s, elasticity, drive_on(s, drive_to(s, theta)), false, false);
  State state = *ClosedForm(system, exact).at(theta);
  TangentStiffness tangent(system.dofs());
  const NewtonResult result = minimise(system, theta, {}, state, tangent);
  return result.converged && result.stable && from_closed_form(s, state, theta) <= 1e-2;
}

TEST(SlenderStrips, OfBasicCellsFoldUpToTheirTippingLength) {
  for (const double k_turn : {0.1, 1.0, 3.0}) {
    const Elasticity elasticity{.k_turn = k_turn};
    const auto cells = [&](double part) { return static_cast<int>(part * tipping_length(elasticity)); };
    EXPECT_TRUE(folds(make_structure(rectangle(cells(0.95), 1), {}), 10 * radians_per_degree, elasticity))
        << k_turn;
    EXPECT_FALSE(folds(make_structure(rectangle(cells(1.05), 1), {}), 10 * radians_per_degree, elasticity))
        << k_turn;
  }
}

Structure bend_by_half_degree(int cells) {
  return alternating(cells, 1, {.beta = 0.5 * radians_per_degree}, basic_unit);
}

EquilibriumPath traced(const Structure& s, double k_turn, int side = 1) {
  EquilibriumPathOptions options = without_contact();
  options.side = side;
  return trace_equilibrium(driven(s, drive_to(s, 30 * radians_per_degree)), {.k_turn = k_turn}, options);
}

TEST(SlenderStrips, ShorterThanTheirTippingLengthFollowTheClosedForm) {
  const Structure s = bend_by_half_degree(1000);
  EXPECT_GT(tipping_length({.k_turn = 0.01}), 1000);
  const EquilibriumPath path = traced(s, 0.01);
  ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << path.why;
  EXPECT_LE(from_closed_form(s, path), 1e-3);
  ASSERT_TRUE(first_event(path, Kind::bifurcation));
  EXPECT_NE(first_event(path, Kind::bifurcation)->what.find("exact mode"), std::string::npos);
}

TEST(SlenderStrips, LongerOnesTipOverToTheSideAskedForAndTellWhy) {
  const Structure s = bend_by_half_degree(60);
  double energy = 0, up = 0;
  for (const int side : {1, -1}) {
    const EquilibriumPath path = traced(s, 10, side);
    ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << path.why;
    EXPECT_TRUE(path.steps.back().stable);
    EXPECT_TRUE(path.off_closed_form);
    EXPECT_TRUE(first_event(path, Kind::bifurcation));
    const double rise = path.state[*s.body_at({60, 1})].p.z() - path.state[*s.body_at({60, 0})].p.z();
    EXPECT_GE(std::abs(rise), 2);
    if (side == -1) {
      EXPECT_LT(rise * up, 0);
      EXPECT_NEAR(path.steps.back().energy, energy, 1e-3 * energy);
    }
    energy = path.steps.back().energy;
    up = rise;
  }
}

}  // namespace
}  // namespace kinetix::model
