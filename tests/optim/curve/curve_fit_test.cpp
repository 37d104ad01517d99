#include "optim/curve/curve_fit.hpp"

#include <gtest/gtest.h>

#include "model/base/invalid_input.hpp"
#include "optim/curve/fit_curve.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::optim {
namespace {

// rad, the usual ranges of a curve target; theta from 0, so that flat states are reached.
constexpr AngleRange tilts{-60 * radians_per_degree, 60 * radians_per_degree};
constexpr AngleRange thetas{0, 44 * radians_per_degree};

void expect_exact_derivatives(const CurveFit& fit, const Eigen::VectorXd& x) {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  ASSERT_TRUE(fit.evaluate(x, r, &J));
  const auto f = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd value;
    fit.evaluate(at, value, nullptr);
    return value;
  };
  testing::expect_jacobian(f, x, J, 1e-7, 1e-5);
}

/// Returns few long segments. No closest point passes a corner, where the distance has a kink.
targets::Curve bent_line() { return targets::Curve({{0, 0}, {60, 5}, {110, 60}}); }

TEST(CurveFit, DerivativesMatchCentralDifferences) {
  const targets::Curve goal = bent_line();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double theta : {1e-4, 0.3, 0.7})
    for (const Per per : {Per::column, Per::all}) {
      const CurveFit fit(goal, make_bend_ties(9, per, Symmetry::none, tilts), 18, thetas);
      Eigen::VectorXd x = fit.pack(std::vector<double>(9, 0.0), theta);
      for (int k = 0; k < fit.ties().variables(); ++k) x[k] = k == 4 ? 0.0 : 0.3 * unit(random);
      x.tail<3>() += 0.02 * Eigen::Vector3d(unit(random), unit(random), unit(random));
      expect_exact_derivatives(fit, x);
    }
}

TEST(CurveFit, IsZeroOnACurveThatItsOwnDesignMakes) {
  const CurveFit maker(bent_line(), make_bend_ties(7, Per::column, Symmetry::none, tilts), 10, thetas);
  Eigen::VectorXd x(11);
  x << 0.1, -0.3, 0.5, 0.2, 0.4, -0.1, 0.3, 0.5, 0, 0, 0;
  model::State poses;
  fold_unchecked(maker.design(x, 0), 10, poses);
  const targets::Curve goal(midline(poses, 0));
  const CurveFit fit(goal, make_bend_ties(7, Per::column, Symmetry::none, tilts), 10, thetas);
  Eigen::VectorXd r;
  ASSERT_TRUE(fit.evaluate(x, r, nullptr));
  EXPECT_LE(r.norm(), 1e-14);
}

TEST(CurveFit, CannotEvaluateNaN) {
  const targets::Curve goal = bent_line();
  const CurveFit fit(goal, make_bend_ties(4, Per::column, Symmetry::none, tilts), 40, thetas);
  Eigen::VectorXd r;
  EXPECT_FALSE(fit.evaluate(Eigen::VectorXd::Constant(8, std::nan("")), r, nullptr));
}

TEST(BendTies, APositiveBendTurnsEveryColumnTowardsPlusZ) {
  const CurveFit fit(bent_line(), make_bend_ties(6, Per::all, Symmetry::none, tilts), 10, thetas);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(5);
  x[0] = 0.4;
  x[1] = 0.5;
  model::State poses;
  fold_unchecked(fit.design(x, 0), 10, poses);
  const auto points = midline(poses, 0);
  for (std::size_t k = 2; k < points.size(); ++k) {
    const Eigen::Vector2d a = points[k - 1] - points[k - 2], b = points[k] - points[k - 1];
    EXPECT_GT(a.x() * b.y() - a.y() * b.x(), 0);
  }
}

TEST(BendTies, MirrorXGivesAFoldedShapeThatIsItsOwnMirrorImage) {
  for (const int columns : {5, 8}) {
    const CurveFit fit(bent_line(), make_bend_ties(columns, Per::column, Symmetry::mirror_x, tilts), 10,
                       thetas);
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(fit.variables(), -0.5, 0.6);
    model::State poses;
    fold_unchecked(fit.design(x, 0), 10, poses);
    const auto points = midline(poses, 0);
    const auto chord = [&](int k) { return (points[k + 1] - points[k]).norm(); };
    const auto span = [&](int a, int b) { return (points[b] - points[a]).norm(); };
    for (int k = 0; k < columns; ++k) EXPECT_NEAR(chord(k), chord(columns - 1 - k), 1e-12);
    for (int k = 0; k < columns; ++k) EXPECT_NEAR(span(0, k), span(columns, columns - k), 1e-12);
  }
}

TEST(BendTies, RefusesTiesThatLeaveTheExactFamily) {
  EXPECT_THROW(make_bend_ties(4, Per::hinge, Symmetry::none, tilts), InvalidInput);
  EXPECT_THROW(make_bend_ties(4, Per::row, Symmetry::none, tilts), InvalidInput);
  EXPECT_THROW(make_bend_ties(4, Per::column, Symmetry::rotate_4, tilts), InvalidInput);
  EXPECT_THROW(make_bend_ties(4, Per::all, Symmetry::none, {0.1, 0.5}), InvalidInput);
}

TEST(ChordLayout, LaysEveryChordAlongTheCurve) {
  const targets::Curve goal = testing::half_circle();
  const ChordLayout layout = lay_chords(goal, 20, 0.0);
  double tau = goal.heading(0);
  for (int c = 0; c < 20; ++c) {
    EXPECT_NEAR(2 * layout.psi[c], -pi / 20, 2e-3) << c;
    tau += 2 * layout.psi[c];
  }
  EXPECT_NEAR(layout.carried_edge_mm * 20, goal.length(), 0.01 * goal.length());
}

TEST(CurveReach, NamesThePlaceWhereTheTurnIsTooTight) {
  const targets::Curve hairpin = targets::Curve({{0, 0}, {100, 0}, {100, 3}, {0, 3}});
  const CurveFit fit(hairpin, make_bend_ties(20, Per::column, Symmetry::none, {-0.3, 0.3}), 12, {0.05, 0.7});
  const CurveReach reach = analyse_reach(fit);
  ASSERT_EQ(reach.obstacles.size(), 1u);
  EXPECT_NE(reach.obstacles[0].find("needs to turn"), std::string::npos) << reach.obstacles[0];
  EXPECT_NE(reach.obstacles[0].find("column 9"), std::string::npos) << reach.obstacles[0];
}

TEST(CurveReach, SaysWhenTheStripIsTooShort) {
  const targets::Curve line = targets::Curve({{0, 0}, {100, 1}, {200, 0}});
  const CurveFit fit(line, make_bend_ties(10, Per::column, Symmetry::none, tilts), 10, {0.05, 0.7});
  const CurveReach reach = analyse_reach(fit);
  ASSERT_EQ(reach.obstacles.size(), 1u);
  EXPECT_NE(reach.obstacles[0].find("200.0 mm long"), std::string::npos) << reach.obstacles[0];
  EXPECT_NEAR(reach.longest_mm, 100 * std::cos(0.05), 1e-9);
}

TEST(CurveReach, CountsBoundsThatLeaveOutZeroFromTheTurnThatIsNeeded) {
  const targets::Curve line = targets::Curve({{0, 0}, {100, 0}, {200, 0}});
  const CurveFit fit(line, make_bend_ties(20, Per::column, Symmetry::none, {0.4, 0.9}), 11.5, {0.1, 0.7});
  const CurveReach reach = analyse_reach(fit);
  for (const ColumnTurn& turn : reach.turns) EXPECT_GT(turn.excess, 0.2) << turn.column;
  ASSERT_EQ(reach.obstacles.size(), 1u);
  EXPECT_NE(reach.obstacles[0].find("at least"), std::string::npos) << reach.obstacles[0];
}

TEST(CurveReach, KnowsThatAColumnMayTurnToOneSideOnly) {
  const targets::Curve goal = testing::half_circle();
  const CurveFit fit(goal, make_bend_ties(20, Per::column, Symmetry::none, {0, 1}),
                     testing::fitting_cell(goal, 20), thetas);
  for (const ColumnTurn& turn : analyse_reach(fit).turns) {
    EXPECT_LT(turn.needed, 0);
    EXPECT_EQ(turn.allowed > 0, turn.column % 2 == 0);
    EXPECT_NEAR(turn.excess, turn.allowed > 0 ? 0 : -turn.needed, 1e-15);
  }
}

TEST(BendTies, MirrorYTiesNothingAndRotate2TiesAsMirrorX) {
  const auto ties = [](Symmetry symmetry) {
    return make_bend_ties(7, Per::column, symmetry, tilts).variable;
  };
  EXPECT_EQ(ties(Symmetry::mirror_y), ties(Symmetry::none));
  EXPECT_EQ(ties(Symmetry::rotate_2), ties(Symmetry::mirror_x));
  EXPECT_EQ(ties(Symmetry::mirror_x), (std::vector<int>{0, 1, 2, 3, 2, 1, 0}));
}

TEST(CurveReach, HasNothingToSayWhenTheGoalIsWithinReach) {
  const targets::Curve goal = testing::half_circle();
  const CurveFit fit(goal, make_bend_ties(20, Per::column, Symmetry::none, tilts),
                     testing::fitting_cell(goal, 20), thetas);
  EXPECT_TRUE(analyse_reach(fit).obstacles.empty());
}

/// At both ends of the ties' ranges, the tilts of the first row stay in their own range.
TEST(BendTies, TieTheTiltsOfTheirStrip) {
  struct Case {
    Per per;
    Symmetry symmetry;
    int variables;
  };
  for (const Case& c : {Case{Per::column, Symmetry::none, 6},
                        {Per::column, Symmetry::mirror_x, 3},
                        {Per::all, Symmetry::none, 1}}) {
    const CurveFit fit(bent_line(), make_bend_ties(6, c.per, c.symmetry, {-0.4, 0.9}), 10, thetas);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(fit.variables());
    for (int k = 0; k < c.variables; ++k) x[k] = (k % 2 == 0 ? 0.1 : -0.1) * (1 + 0.5 * k);
    x[c.variables] = 0.4;
    const model::Structure strip = sheet_of(fit.design(x, 2), {10, 0.8, 6});
    const std::vector<TiltTie> ties = tied_tilts(strip, fit.ties());
    ASSERT_EQ(ties.size(), static_cast<std::size_t>(c.variables));
    std::vector<double> least, most;
    for (const TiltTie& tie : ties) {
      EXPECT_EQ(tie.hinges.size(), 18u / c.variables);
      EXPECT_EQ(tie.signs.size(), tie.hinges.size());
      EXPECT_TRUE(tie.range.lower < tie.tilt && tie.tilt < tie.range.upper);
      least.push_back(tie.range.lower);
      most.push_back(tie.range.upper);
    }
    for (const std::vector<double>& sizes : {least, most}) {
      const model::Lattice changed = with_tilts(strip, ties, sizes);
      for (const model::Hinge& hinge : changed.squares()->hinges) {
        if (hinge.wall.axis != model::Axis::x || hinge.wall.from.j != 0) continue;
        EXPECT_GE(hinge.parameters.beta, -0.4 - 1e-12);
        EXPECT_LE(hinge.parameters.beta, 0.9 + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace kinetix::optim
