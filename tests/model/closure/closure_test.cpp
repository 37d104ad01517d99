#include "model/closure/closure.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using testing::random_design;
using testing::structure_of;

Eigen::VectorXd random_twists(const Structure& s, double size, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-size, size);
  Eigen::VectorXd twists(6 * s.bodies.size());
  for (double& x : twists) x = unit(random);
  return twists;
}

Structure random_structure(int columns, int rows, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Structure s = make_structure(rectangle(columns, rows), {});
  for (Hinge& h : s.hinges)
    h.parameters = {0.5 + 0.4 * unit(random), pi / 2 + 0.8 * unit(random), 0.8 * unit(random)};
  return s;
}

/// The y-wall of body (0, 0), which turns by -2 theta.
HingeTurn turn_to(const Structure& s, double theta) { return {*s.hinge_at({{0, 0}, Axis::y}), -2 * theta}; }

/// Each alone, the tilts of columns and of rows are exactly mobile; together they are not.
Structure doubly_curved(const std::vector<double>& column, const std::vector<double>& row) {
  Structure s = make_structure(rectangle(static_cast<int>(column.size()), static_cast<int>(row.size())), {});
  for (Hinge& h : s.hinges) {
    const auto [i, j] = h.wall.from;
    const bool along_x = h.wall.axis == Axis::x;
    const double tilt = along_x ? column[i] : row[j];
    h.parameters.beta = ((along_x ? j : i) & 1) ? -tilt : tilt;
  }
  return s;
}

Closure follow(const Structure& s, double theta, int steps) {
  Closure reached;
  reached.state = rest_state(s);
  for (int k = 1; k <= steps; ++k) reached = solve_closure(s, reached.state, {turn_to(s, theta * k / steps)});
  return reached;
}

TEST(Closure, ResidualIsTheHingeGap) {
  std::mt19937 random(21);
  const Structure s = random_structure(4, 3, random);
  const State state = retract_straight(s, rest_state(s), random_twists(s, 0.3, random));
  const Eigen::VectorXd r = closure_residual(s, state);
  const HingeGaps gaps = hinge_gaps(s, state);
  double worst = 0, worst_axis = 0;
  for (Eigen::Index k = 0; k < r.size(); k += 6) {
    worst = std::max(worst, r.segment<3>(k).norm());
    worst_axis = std::max(worst_axis, 2 * std::asin(r.segment<3>(k + 3).norm() / 2));
  }
  EXPECT_NEAR(worst, gaps.max, 1e-14) << "seed 21";
  EXPECT_NEAR(worst_axis, gaps.axis_max, 1e-14) << "seed 21";
}

TEST(Closure, JacobianMatchesCentralDifferences) {
  std::mt19937 random(22);
  const Structure s = random_structure(3, 2, random);
  const State state = retract_straight(s, rest_state(s), random_twists(s, 0.5, random));
  const auto f = [&](const Eigen::VectorXd& x) { return closure_residual(s, retract_straight(s, state, x)); };
  testing::expect_jacobian(f, Eigen::VectorXd::Zero(6 * s.bodies.size()), closure_jacobian(s, state), 1e-10);
}

TEST(Closure, DriveGradientsMatchCentralDifferences) {
  std::mt19937 random(23);
  const Structure s = random_structure(2, 1, random);
  const State state = retract_straight(s, rest_state(s), random_twists(s, 0.5, random));
  const BodyPush push{4, rest_state(s)[4], {{0.3, -0.2, 0.9}, {0.5, 0.1, -0.4}}, 0.1};
  for (const ClosureDrive& drive : {ClosureDrive(HingeTurn{5, 0.3}), ClosureDrive(push)}) {
    const auto f = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd::Constant(1, drive_residual(drive, s, retract_straight(s, state, x)));
    };
    std::vector<Eigen::Triplet<double>> entries;
    append_drive_gradient(drive, s, state, 0, entries);
    Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(1, 6 * s.bodies.size());
    for (const auto& e : entries) gradient(0, e.col()) += e.value();
    testing::expect_jacobian(f, Eigen::VectorXd::Zero(6 * s.bodies.size()), gradient, 1e-10);
  }
}

TEST(Closure, HingeTurnOfAnExactStateIsTwiceTheta) {
  std::mt19937 random(24);
  for (const Family family : {Family::F1, Family::F2, Family::F3}) {
    const auto design = random_design(family, 5, 4, random);
    const Structure s = structure_of(design);
    EXPECT_NEAR(drive_residual(turn_to(s, design.theta), s, fold(design, s)), 0, 1e-13) << "seed 24";
  }
}

TEST(ClosureSolver, ReturnsAPerturbedExactStateToTheReflectionRecursion) {
  std::mt19937 random(25);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {3, 2}, {12, 1}, {6, 6}}) {
      const auto design = random_design(family, columns, rows, random);
      const Structure s = structure_of(design);
      const State exact = fold(design, s);
      const State start = retract_straight(s, exact, random_twists(s, 0.01, random));
      const Closure reached = solve_closure(s, start, {turn_to(s, design.theta)});
      EXPECT_TRUE(reached.closed) << reached.why;
      EXPECT_LE(aligned_distance(s, reached.state, exact).max, 1e-9)
          << to_string(family) << " " << columns << "x" << rows << " theta " << design.theta << " seed 25";
    }
}

TEST(ClosureSolver, DrivenFromFlatLandsOnTheReflectionRecursion) {
  std::mt19937 random(26);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {2, 2}, {5, 3}, {10, 1}}) {
      auto design = random_design(family, columns, rows, random);
      design.theta = 0.5;
      const Structure s = structure_of(design);
      const Closure reached = follow(s, design.theta, 10);
      EXPECT_TRUE(reached.closed) << reached.why;
      EXPECT_LE(aligned_distance(s, reached.state, fold(design, s)).max, 1e-9)
          << to_string(family) << " " << columns << "x" << rows << " seed 26";
    }
}

TEST(ClosureSolver, PushedBodyLeadsToTheSameStateAsItsHinge) {
  std::mt19937 random(28);
  auto design = random_design(Family::F2, 4, 3, random);
  design.theta = 0.1;
  const Structure s = structure_of(design);
  const State rest = rest_state(s);
  const BodyPush push{1, rest[1], {{0, 0, 1}, {0, 0, 0}}, -2 * design.theta};
  const Closure reached = solve_closure(s, rest, {push});
  EXPECT_TRUE(reached.closed) << reached.why;
  EXPECT_LE(aligned_distance(s, reached.state, fold(design, s)).max, 1e-9) << "seed 28";
}

TEST(ClosureSolver, StandsInTheMiddleBetweenTwoDrivesThatDisagree) {
  const Structure s = make_structure(rectangle(3, 1), {});
  const HingeTurn low = turn_to(s, 0.2), high = turn_to(s, 0.3);
  const Closure reached = solve_closure(s, follow(s, 0.2, 2).state, {low, high});
  EXPECT_TRUE(reached.converged) << reached.why;
  EXPECT_FALSE(reached.closed);
  EXPECT_NEAR(drive_residual(low, s, reached.state), -0.1, 1e-9);
  EXPECT_NEAR(drive_residual(high, s, reached.state), 0.1, 1e-9);
  EXPECT_NEAR(reached.residual, 0.1, 1e-9);
  EXPECT_LE(hinge_gaps(s, reached.state).max, 1e-9);
}

TEST(ClosureSolver, LeavesAMisfitInDoublyCurvedPatches) {
  const Structure patches[] = {doubly_curved({0.6, 0.9}, {0.8, 0.5}), doubly_curved({0.4, 0.9}, {0.9, 0.5}),
                               doubly_curved({0.7, 0.2, 0.7}, {0.7, 0.3, 0.7}),
                               doubly_curved({0.3, 0.7, 0.6}, {0.7, 0.2, 0.6})};
  for (const Structure& s : patches) {
    const Closure reached = follow(s, 0.4, 8);
    EXPECT_TRUE(reached.converged) << reached.why;
    EXPECT_FALSE(reached.closed);
    const double misfit = hinge_gaps(s, reached.state).max;
    EXPECT_GE(misfit, 4e-3);
    EXPECT_LE(misfit, 1.4e-2);
    EXPECT_NEAR(drive_residual(turn_to(s, 0.4), s, reached.state), 0, 1e-6);
  }
}

TEST(ClosureSolver, MisfitOfADoublyCurvedPatchVanishesWithEitherCurvature) {
  const std::vector<double> tilts = {0.6, 0.5, 0.7}, none = {0, 0, 0};
  EXPECT_TRUE(follow(doubly_curved(tilts, none), 0.4, 8).closed);
  EXPECT_TRUE(follow(doubly_curved(none, tilts), 0.4, 8).closed);
}

TEST(ClosureSolver, FindsTheTwistedStateOfEquationSix) {
  std::mt19937 random(27);
  for (const double alpha : {1.1, 1.3, 1.5, 1.8}) {
    Structure s = make_structure(rectangle(1, 1), {});
    const Structure basic = s;
    const CellTuple tuple{.A_in = {pi / 2, alpha, pi / 2, alpha}};
    apply_pattern(s, tuple, tuple, SharedWalls::must_agree);
    const State near = fold(classify(basic), basic, -pi / 4);
    const Closure reached = solve_closure(s, retract_straight(s, near, random_twists(s, 0.2, random)), {});
    EXPECT_TRUE(reached.closed) << reached.why << " seed 27";
    EXPECT_NEAR(std::abs(hinge_turn(s, reached.state, 0)), pi / 2, 1e-12);
    const Eigen::Vector3d up = reached.state[0].R.col(2), other = reached.state[1].R.col(2);
    EXPECT_NEAR(std::atan2(up.cross(other).norm(), up.dot(other)), std::abs(pi - twist_angle(alpha)), 1e-12);
  }
}

TEST(ClosureSolver, FindsABarrierBetweenTheTwoStatesOfATwistUnit) {
  double last = 0;
  for (const double lean : {0.05, 0.1, 0.2, 0.4}) {
    Structure s = make_structure(rectangle(1, 1), {});
    const CellTuple tuple{.A_in = {pi / 2, pi / 2 - lean, pi / 2, pi / 2 - lean}};
    apply_pattern(s, tuple, tuple, SharedWalls::must_agree);
    const Closure reached = follow(s, -0.4, 8);
    EXPECT_TRUE(reached.converged) << reached.why;
    EXPECT_GT(reached.residual, last);
    last = reached.residual;
  }
  EXPECT_GT(last, 1e-2);
}

TEST(ClosureSolver, ReportsNumbersThatAreNotFiniteAsNotConverged) {
  const Structure s = make_structure(rectangle(2, 1), {});
  State start = rest_state(s);
  start[3].p.x() = std::numeric_limits<double>::quiet_NaN();
  const Closure reached = solve_closure(s, start, {});
  EXPECT_FALSE(reached.converged);
  EXPECT_FALSE(reached.closed);
  EXPECT_FALSE(solve_closure(s, rest_state(s), {turn_to(s, 0.3)}, {.max_iterations = 1}).converged);
}

TEST(ClosureSolver, RefusesDrivesAndOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Structure s = make_structure(rectangle(1, 1), {});
  const State rest = rest_state(s);
  EXPECT_THROW(solve_closure(s, {}, {}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {HingeTurn{4, 0.1}}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {HingeTurn{-1, 0.1}}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {HingeTurn{0, nan}}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {HingeTurn{0, pi}}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {BodyPush{1, {}, {}, 0.1}}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {BodyPush{9, {}, {{1, 0, 0}, {0, 0, 0}}, 0.1}}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {}, {.max_iterations = -1}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {}, {.tolerance = nan}), InvalidInput);
  EXPECT_THROW(solve_closure(s, rest, {}, {.step_tolerance = 0}), InvalidInput);
}

}  // namespace
}  // namespace kinetix::model
