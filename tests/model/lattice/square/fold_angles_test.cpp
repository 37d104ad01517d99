#include <gtest/gtest.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/family/fold_angles.hpp"
#include "model/lattice/square/family/net.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::model {
namespace {

Structure with_tilts(std::vector<Cell> cells, const std::vector<std::pair<Wall, double>>& tilts_deg) {
  Structure s = make_structure(std::move(cells), {});
  for (const auto& [wall, tilt] : tilts_deg)
    s.hinges[*s.hinge_at(wall)].parameters.beta = tilt * radians_per_degree;
  return s;
}

/// Three cells round a corner, whose creases cross in the first.
Structure corner() {
  return with_tilts({{1, 0}, {1, 1}, {0, 1}}, {{{{1, 0}, Axis::x}, -10},
                                               {{{1, 1}, Axis::x}, 10},
                                               {{{1, 2}, Axis::x}, -10},
                                               {{{1, 0}, Axis::y}, 20},
                                               {{{2, 0}, Axis::y}, -20}});
}

/// Every second crease gets a tilt of 5 to 40 deg, some of them the same.
void tilt_creases(Structure& s, std::mt19937& random) {
  std::uniform_real_distribution<double> tilt(5 * radians_per_degree, 40 * radians_per_degree);
  std::bernoulli_distribution coin;
  const double often = tilt(random);
  for (const Crease& crease : find_creases(s).list) {
    if (coin(random)) continue;
    const double size = coin(random) ? often : tilt(random);
    set_tilt(s, crease, coin(random) ? size : -size);
  }
}

bool has_crossing(const Structure& s) {
  return std::any_of(s.cell_members.begin(), s.cell_members.end(), [&](const CellHinges& cell) {
    return s.hinges[cell.hinges[0]].parameters.beta != 0 && s.hinges[cell.hinges[1]].parameters.beta != 0;
  });
}

/// Drives the flat structure by one hinge to its turn in the closed form, with a solver that does not know the
/// families.
Closure driven_to(const Structure& s, const Classification& kind, int hinge, double theta) {
  constexpr int steps = 12;
  Closure reached;
  reached.state = fold(kind, s, theta / steps);  // off flat, where several motions may part
  for (int k = 1; k <= steps && (k == 1 || reached.converged); ++k) {
    const double turn = hinge_turn(s, fold(kind, s, theta * k / steps), hinge);
    reached = solve_closure(s, reached.state, {HingeTurn{hinge, turn}});
  }
  return reached;
}

TEST(FoldAngles, ACornerOfCrossingCreasesIsExactlyMobile) {
  const Structure s = corner();
  const Classification kind = classify(s);
  ASSERT_EQ(kind.family, Family::F4) << kind.why;
  for (double theta = -80 * radians_per_degree; theta <= 80 * radians_per_degree;
       theta += 5 * radians_per_degree) {
    const HingeGaps gaps = hinge_gaps(s, fold(kind, s, theta));
    EXPECT_LE(gaps.max, 1e-14) << theta;
    EXPECT_LE(gaps.axis_max, 1e-14) << theta;
  }
  const int hinge = *s.hinge_at({{0, 1}, Axis::y});
  for (const double theta : {20 * radians_per_degree, -20 * radians_per_degree, 40 * radians_per_degree}) {
    const Closure reached = driven_to(s, kind, hinge, theta);
    EXPECT_TRUE(reached.closed) << reached.why;
    EXPECT_LE(aligned_distance(s, reached.state, fold(kind, s, theta)).max, 1e-9);
  }
}

/// Compares the rules with the null space on random sheets. Enough of them have crossing creases and move, and enough
/// are refused.
void expect_rules_of_sheets(int sheets) {
  constexpr unsigned seed = 61;
  std::mt19937 random(seed);
  int crossing = 0, refused = 0;
  for (int k = 0; k < sheets; ++k) {
    Structure s = make_structure(testing::random_cells(1 + k % 8, random), {});
    tilt_creases(s, random);
    const NetCheck check = check_net(s);
    const Mobility m = mobility(s, {}, {.turn = 0.8});
    EXPECT_EQ(check.broken == 0, m.verdict == Verdict::mobile)
        << "seed " << seed << ", sheet " << k << ": " << check.rule << "; " << m.why;
    crossing += check.broken == 0 && has_crossing(s);
    refused += check.broken > 0;
  }
  EXPECT_GE(crossing, sheets * 40 / 150);
  EXPECT_GE(refused, sheets * 20 / 150);
}

TEST(FoldAngles, SheetsThatTheRulesAcceptMoveAndThoseTheyRefuseDoNot) { expect_rules_of_sheets(40); }

TEST(FoldAnglesSoak, SheetsThatTheRulesAcceptMoveAndThoseTheyRefuseDoNot) { expect_rules_of_sheets(150); }

/// Compares the rules with the null space on rings of random creases.
void expect_rules_of_rings(int rings) {
  constexpr unsigned seed = 62;
  std::mt19937 random(seed);
  std::vector<Cell> ring = rectangle(3, 3);
  std::erase(ring, Cell{1, 1});
  int crossing = 0, refused = 0;
  for (int k = 0; k < rings; ++k) {
    Structure s = make_structure(ring, {});
    for (const Crease& crease : find_creases(s).list)
      if (std::bernoulli_distribution(0.25 + 0.5 * (k % 2))(random)) set_tilt(s, crease, 0.3);
    const NetCheck check = check_net(s);
    const Mobility m = mobility(s, {}, {.turn = 0.8});
    EXPECT_EQ(check.broken == 0, m.verdict == Verdict::mobile)
        << "seed " << seed << ", ring " << k << ": " << check.rule << "; " << m.why;
    crossing += check.broken == 0 && has_crossing(s);
    refused += check.broken > 0;
  }
  EXPECT_GE(crossing, rings / 20);
  EXPECT_GE(refused, rings / 3);
}

TEST(FoldAngles, RingsThatTheRulesAcceptMoveAndThoseTheyRefuseDoNot) { expect_rules_of_rings(20); }

TEST(FoldAnglesSoak, RingsThatTheRulesAcceptMoveAndThoseTheyRefuseDoNot) { expect_rules_of_rings(60); }

TEST(FoldAngles, AnIndependentSolverFindsTheClosedForm) {
  constexpr unsigned seed = 63;
  std::mt19937 random(seed);
  int crossing = 0;
  for (int k = 0; crossing < 25; ++k) {
    ASSERT_LT(k, 1000);
    Structure s = make_structure(testing::random_cells(3 + k % 12, random), {});
    tilt_creases(s, random);
    const Classification kind = classify(s);
    if (kind.family != Family::F4 || !has_crossing(s)) continue;
    ++crossing;
    for (const double theta : {0.5, -0.5}) {
      const Closure reached = driven_to(s, kind, k % static_cast<int>(s.hinges.size()), theta);
      EXPECT_TRUE(reached.closed) << "seed " << seed << ", sheet " << k << ": " << reached.why;
      EXPECT_LE(aligned_distance(s, reached.state, fold(kind, s, theta)).max, 1e-8)
          << "seed " << seed << ", sheet " << k << ", theta " << theta;
    }
  }
}

/// An L of rows and columns round a hole whose corner is left out: round the hole the creases come in the
/// order x, x, y, y, and their lines do not cross in it.
TEST(FoldAngles, ARingMayHoldCreasesBothWaysThatDoNotCrossInItsHole) {
  std::vector<Cell> cells;
  for (const Cell& c : rectangle(5, 5)) {
    const bool in_hole = (c.i >= 1 && c.j == 1 && c.i <= 3) || (c.i == 1 && c.j >= 1 && c.j <= 3);
    if (!in_hole && !(c.i >= 3 && c.j >= 3)) cells.push_back(c);
  }
  Structure s = make_structure(std::move(cells), {});
  const Creases creases = find_creases(s);
  for (const Wall wall : {Wall{{3, 0}, Axis::x}, {{3, 2}, Axis::x}, {{0, 3}, Axis::y}, {{2, 3}, Axis::y}})
    set_tilt(s, creases.list[creases.of_hinge[*s.hinge_at(wall)]], 0.3);
  EXPECT_EQ(check_net(s).broken, 0u) << check_net(s).rule;
  EXPECT_EQ(mobility(s, {}, {.turn = 0.8}).verdict, Verdict::mobile);
}

/// Column tilts are arbitrary, and rows share one tilt. Theta of F3 is half the turn of its first y-wall.
TEST(FoldAngles, ATiltedSheetFoldsAsTheReflectionsOfItsFamilyDo) {
  constexpr unsigned seed = 64;
  std::mt19937 random(seed);
  for (const auto& [columns, rows] : {std::pair{1, 1}, {5, 1}, {4, 3}}) {
    const auto design = testing::random_design(Family::F3, columns, rows, random);
    const Structure sheet = testing::structure_of(design);
    EXPECT_EQ(check_net(sheet).broken, 0u);
    const double theta = std::atan(std::tan(design.theta) * std::cos(design.gamma));
    EXPECT_NEAR(half_turn(design.gamma, theta), design.theta, 1e-14);
    const State net = fold_net(make_net_tree(sheet), sheet, theta);
    EXPECT_LE(aligned_distance(sheet, net, fold(design, sheet)).max, 1e-12) << "seed " << seed;
  }
}

TEST(FoldAngles, HingesTurnByTwiceTheHalfTurnOfTheirCrease) {
  constexpr unsigned seed = 65;
  std::mt19937 random(seed);
  for (int k = 0; k < 20; ++k) {
    const Structure s = testing::random_net(20, random);
    const Creases creases = find_creases(s);
    const NetTree tree = make_net_tree(s);
    const std::vector<double> shifts = fold_shifts(tree.angles, s);
    const double theta = 0.1 * k - 0.9;
    const State state = fold_net(tree, s, theta);
    for (std::size_t h = 0; h < s.hinges.size(); ++h) {
      const double own = model::fold_angle(theta, shifts[creases.of_hinge[h]]).value;
      const double turn = -2 * s.hinges[h].wall.from.sense() * half_turn(s.hinges[h].parameters.beta, own);
      EXPECT_NEAR(std::remainder(hinge_turn(s, state, static_cast<int>(h)) - turn, 2 * pi), 0, 1e-11)
          << "seed " << seed;
    }
  }
}

TEST(FoldAngles, DerivativesMatchCentralDifferences) {
  for (const double shift : {-3.0, -0.4, 0.7, 5.0})
    for (const double theta : {-1.4, -0.3, 0.0, 0.5, 1.5}) {
      const auto value = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, model::fold_angle(x[0], x[1]).value);
      };
      const FoldAngle angle = model::fold_angle(theta, shift);
      testing::expect_jacobian(value, Eigen::Vector2d(theta, shift),
                               Eigen::RowVector2d(angle.by_theta, angle.by_shift));
    }
}

TEST(FoldAngles, ShiftsAreExactlyZeroWhereNoCreaseThatBendsCrossesAnother) {
  const Structure net = testing::cube_net(0.7);
  for (const double shift : fold_shifts(make_net_tree(net).angles, net)) EXPECT_EQ(shift, 0);
  EXPECT_EQ(model::fold_angle(0.3, 0).value, 0.3);
}

/// No wall of these three cells stands upright.
TEST(FoldAngles, ADriveTakesANetWithoutAnUprightHingeToTheta) {
  Structure s = make_structure({{0, 0}, {1, 0}, {1, 1}}, {});
  double tilt = 0.15;
  for (const Crease& crease : find_creases(s).list) set_tilt(s, crease, tilt += 0.05);
  const Classification kind = classify(s);
  ASSERT_EQ(kind.family, Family::F4) << kind.why;
  for (const double theta : {0.5, -0.5}) {
    const auto drive = std::get<HingeTurn>(drive_to(s, theta));
    EXPECT_NEAR(hinge_turn(s, fold(kind, s, theta), drive.hinge), drive.angle, 1e-13);
  }
}

}  // namespace
}  // namespace kinetix::model
