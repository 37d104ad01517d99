#include "optim/curve/fit_curve.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "model/base/invalid_input.hpp"
#include "model/hinge/crease_law.hpp"
#include "tests/support/curves.hpp"

namespace kinetix::optim {
namespace {

CurveVariables strip(const targets::Curve& goal, int columns) {
  CurveVariables variables;
  variables.columns = columns;
  variables.cell_mm = testing::fitting_cell(goal, columns);
  return variables;
}

TEST(FitCurve, RecoversCurvesThatSomeDesignReachesExactly) {
  std::mt19937 random(21);
  for (const int columns : {6, 9, 17, 28, 40})
    for (int found = 0; found < 4;) {
      const auto goal = testing::reachable_curve(columns, 8, random);
      if (!goal) continue;
      ++found;
      CurveVariables variables;
      variables.columns = columns;
      const CurveDesign result = fit_curve(*goal, variables, {});
      EXPECT_LE(result.error.rms, 1e-6) << columns << " columns, seed 21";
    }
}

TEST(FitCurve, ErrorFallsAsTheSquareOfTheColumns) {
  for (const targets::Curve& goal : {testing::half_circle(), testing::s_curve()}) {
    double before = 0;
    for (const auto& [columns, limit] : {std::pair{10, 3e-3}, {20, 9e-4}, {40, 3e-4}, {80, 8e-5}}) {
      const double rms = fit_curve(goal, strip(goal, columns), {}).error.rms;
      EXPECT_LE(rms, limit) << columns;
      if (before > 0) {
        EXPECT_NEAR(before / rms, 4, 0.6) << columns;
      }
      before = rms;
    }
  }
}

TEST(FitCurve, GivesTheSameDesignForAnyNumberOfThreads) {
  const targets::Curve goal = testing::s_curve();
  MultiStartOptions options;
  options.starts = 20;
  options.threads = 1;
  const CurveDesign one = fit_curve(goal, strip(goal, 12), options);
  options.threads = 4;
  const CurveDesign four = fit_curve(goal, strip(goal, 12), options);
  EXPECT_EQ(one.design.beta, four.design.beta);
  EXPECT_EQ(one.design.theta, four.design.theta);
  EXPECT_EQ(one.chosen, four.chosen);
}

TEST(FitCurve, OneTiltForAllColumnsMakesAnArc) {
  const targets::Curve goal = testing::half_circle();
  CurveVariables variables = strip(goal, 30);
  variables.per = Per::all;
  const CurveDesign result = fit_curve(goal, variables, {});
  EXPECT_LE(result.error.rms, 1e-3);
  for (int c = 1; c < 30; ++c) EXPECT_EQ(result.design.beta[c], -result.design.beta[c - 1]);
}

TEST(FitCurve, StaysWithinItsBounds) {
  const targets::Curve goal = testing::half_circle();
  CurveVariables variables = strip(goal, 10);
  variables.beta = {-0.1, 0.1};
  variables.theta = {0.2, 0.5};
  const CurveDesign result = fit_curve(goal, variables, {});
  for (const double beta : result.design.beta) EXPECT_LE(std::abs(beta), 0.1 + 1e-12);
  EXPECT_GE(result.design.theta, 0.2);
  EXPECT_LE(result.design.theta, 0.5);
  EXPECT_GT(result.error.rms, 0.02);
  EXPECT_FALSE(result.reach.obstacles.empty());
}

TEST(FitCurve, RefusesVariablesOutOfRange) {
  const targets::Curve goal = testing::half_circle();
  const double nan = std::nan("");
  for (const auto& change : std::vector<std::function<void(CurveVariables&)>>{
           [](auto& v) { v.columns = 1; }, [](auto& v) { v.rows = 0; }, [](auto& v) { v.cell_mm = 0; },
           [=](auto& v) { v.cell_mm = nan; },
           [](auto& v) {
             v.theta = {0.7, 0.1};
           },
           [](auto& v) {
             v.theta = {0, 0.7};
           },
           [=](auto& v) { v.theta.upper = nan; },
           [](auto& v) {
             v.beta = {-1.6, 1};
           },
           [=](auto& v) { v.beta.lower = nan; }}) {
    CurveVariables wrong = strip(goal, 10);
    change(wrong);
    EXPECT_THROW(fit_curve(goal, wrong, {}), InvalidInput);
  }
}

TEST(FitFreeCurve, KeepsThetaBelowTheAngleAtWhichBasicCellsClose) {
  const targets::Curve line({{0, 0}, {50, 0}, {100, 0}});
  CurveVariables variables = strip(line, 10);
  variables.cell_mm = 14;
  variables.theta = {0.1, 44.9 * radians_per_degree};
  const FreeCurveDesign found = fit_free_curve(line, variables, {14, 2, 8}, {});
  EXPECT_LT(found.design.design.theta, std::atan(1 - 2.0 / 14));
  EXPECT_FALSE(found.contact.touches);
  ASSERT_FALSE(found.notes.empty());
  EXPECT_NE(found.notes[0].find("fold angle limited to"), std::string::npos) << found.notes[0];
}

model::CellSize usual_walls(const CurveVariables& v) { return {v.cell_mm, 0.1 * v.cell_mm, 0.6 * v.cell_mm}; }

/// Gentle tilts miss this corner by a little more than steep ones do. The search chooses both ranges.
TEST(FitFreeCurve, SpeaksOfTheTiltsThatWereAskedForWhateverItNarrows) {
  const targets::Curve corner({{0, 0}, {100, 0}, {100, 100}});
  CurveVariables variables = strip(corner, 38);
  variables.symmetry = Symmetry::mirror_x;
  const FreeCurveDesign gentle = fit_free_curve(corner, variables, usual_walls(variables), {}),
                        near = fit_free_curve(corner, variables, usual_walls(variables), {}, 1e-3);
  for (const FreeCurveDesign* found : {&gentle, &near}) {
    EXPECT_FALSE(found->contact.touches);
    const CurveReach& reach = found->design.reach;
    const double most = model::crease_turn(variables.beta.upper, reach.theta);
    for (const ColumnTurn& turn : reach.turns) EXPECT_NEAR(turn.allowed, most, 1e-12) << turn.column;
    EXPECT_TRUE(reach.obstacles.empty()) << reach.obstacles.front();
  }
  EXPECT_LT(near.design.error.rms, 0.95 * gentle.design.error.rms);
}

/// Tilts that follow these corners make walls collide; a smaller theta does not.
TEST(FitFreeCurve, FindsASmallerThetaWhereWallsWouldMeet) {
  const targets::Curve step({{0, 0}, {30, 0}, {30, 30}, {60, 30}});
  const CurveVariables variables = strip(step, 17);
  const FreeCurveDesign found = fit_free_curve(step, variables, usual_walls(variables), {}, 0.01);
  EXPECT_FALSE(found.contact.touches);
  EXPECT_LE(found.design.error.rms, 0.01);
  EXPECT_NE(found.narrowed.find("fold angle limited to"), std::string::npos) << found.narrowed;
  ASSERT_FALSE(found.notes.empty());
  EXPECT_EQ(found.notes.back(), found.narrowed);
}

}  // namespace
}  // namespace kinetix::optim
