#include <gtest/gtest.h>
#include <cmath>

#include "model/elastic/path/near_equilibrium.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/elastic/compensation.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr double held_theta = 0.5;  // rad: large enough to show what the springs hold back

/// Returns a strip of one row whose columns bend to the same side, by the tilts of their walls along x. The tilts grow
/// by 5 % of `tilt` per column.
model::Lattice bent_strip(int columns, double tilt) {
  model::Structure s = make_structure(model::rectangle(columns, 1), {10, 0.8, 6});
  for (model::Hinge& hinge : s.hinges)
    if (hinge.wall.axis == model::Axis::x)
      hinge.parameters.beta =
          (starts_in_sublattice_b(hinge.wall) ? -tilt : tilt) * (1 + 0.05 * hinge.wall.from.i);
  return s;
}

/// Returns blocks of rubber as hinges, which springs fold below.
model::Elasticity rubber() { return model::elasticity_of(model::HingeStiffness{6, 1.5, 1.5, 0.3}, 1.7); }

model::LinkageDrive springs(const model::Lattice& sheet, double to) {
  return drive_on(sheet, model::ShapeMemory{.angle = 2 * to, .k_turn = 3});
}

/// Every vertex where the exact state has it, in all directions.
ElasticGoal goal_of(const model::State& exact) {
  ElasticGoal goal;
  goal.drive = springs;
  goal.observe = [exact](const model::Lattice&, const model::State& state) {
    const model::State placed = aligned(exact, state);
    std::vector<model::ObservedPoint> points;
    for (int b = 0; b < static_cast<int>(state.size()); ++b)
      for (int k = 0; k < 3; ++k)
        points.push_back({{b}, state[b].p, Vector3d::Unit(k), (state[b].p - placed[b].p)[k]});
    return points;
  };
  return goal;
}

ElasticFit settled(const model::Lattice& sheet) {
  const model::ExactMotion exact = exact_motion(sheet);
  const model::EquilibriumPath path = trace_equilibrium({sheet, springs(sheet, held_theta), exact}, rubber());
  EXPECT_EQ(path.stop, model::EquilibriumPath::Stop::reached) << path.why;
  return {sheet, held_theta, path.state, 0};
}

TEST(Compensate, BringsSoftHingesBackToTheExactState) {
  const model::Lattice sheet = bent_strip(8, 0.3);
  const ElasticGoal goal = goal_of(exact_motion(sheet).at(held_theta));
  const Compensation found = compensate(settled(sheet), rubber(), goal);
  EXPECT_GT(found.before.rms_mm, 1) << "the springs hold the fold back";
  EXPECT_LT(found.after.rms_mm, found.before.rms_mm / 50) << found.why;
  EXPECT_GT(found.after.theta, held_theta) << "more heat makes up for the hinges' own springs";

  // A separate path from flat reaches the same state.
  const model::EquilibriumPath again = trace_equilibrium(
      {found.after.sheet, springs(found.after.sheet, found.after.theta), exact_motion(found.after.sheet)},
      rubber());
  EXPECT_LE(aligned_distance(sheet, again.state, found.after.state).max, 1e-8);
}

TEST(Compensate, EndsAtOnceWhereTheGoalIsMet) {
  const model::Lattice sheet = bent_strip(4, 0.3);
  const ElasticFit start = settled(sheet);
  const Compensation found = compensate(start, rubber(), goal_of(start.state), {.enough_mm = 1e-6});
  EXPECT_EQ(found.rounds, 0);
  EXPECT_EQ(found.largest_change, 0);
  EXPECT_EQ(found.why, "it meets the goal");
}

// Each variable is changed alone, and the equilibrium is followed to both sides.
TEST(Compensate, KnowsHowDeviationsChange) {
  const model::Lattice sheet = bent_strip(4, 0.3);
  const ElasticFit at = settled(sheet);
  const ElasticGoal goal = goal_of(exact_motion(sheet).at(held_theta));
  const std::vector<TiltTie> ties = tilt_ties(sheet);
  const auto found = deviation_jacobian(at, ties, rubber(), goal, true);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->jacobian.cols(), static_cast<Eigen::Index>(ties.size()) + 1);

  const auto deviations_at = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    const std::vector<double> tilts(x.data(), x.data() + ties.size());
    const model::Lattice changed = with_tilts(sheet, ties, tilts);
    const model::EquilibriumPath path = follow_change(
        at.state,
        [&](double) {
          return model::DrivenLinkage{changed, springs(changed, x[x.size() - 1]), {}};
        },
        rubber());
    // Against the same places as before, along the same directions, less what a rigid motion does.
    std::vector<model::ObservedPoint> moved = goal.observe(sheet, at.state);
    for (model::ObservedPoint& p : moved) p.miss_mm += p.normal.dot(path.state[p.bodies[0]].p - p.place);
    return model::ObservedPoints(moved, true).aligned_deviations();
  };
  Eigen::VectorXd x(found->jacobian.cols());
  for (std::size_t k = 0; k < ties.size(); ++k) x[static_cast<Eigen::Index>(k)] = ties[k].tilt;
  x[x.size() - 1] = held_theta;
  testing::expect_jacobian(deviations_at, x, found->jacobian, 1e-6);
}

}  // namespace
}  // namespace kinetix::optim
