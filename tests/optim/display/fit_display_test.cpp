#include "optim/display/fit_display.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/regular_lattices.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;

/// Levels of the paper's letter T (tests/support/paper_scenes.hpp), by the cells' order.
std::vector<double> letter_t(const model::Structure& panel, int cells) {
  const int middle = cells / 2, top = cells - 2;
  std::vector<double> levels;
  for (const auto& [i, j] : panel.cells) {
    const bool bar = j == top - 1 || j == top, stem = i == middle - 1 || i == middle;
    levels.push_back((bar && i >= 1 && i <= top) || (stem && j >= 1 && j <= top) ? 1 : 0);
  }
  return levels;
}

DisplayOptions pressed(double compression) {
  DisplayOptions options;
  options.plates.compression = compression;
  return options;
}

TEST(RuleDisplay, IsThePapersLetterT) {
  const model::Structure panel = make_structure(model::rectangle(10, 10), {}),
                         paper = testing::letter_panel(0.15);
  const VectorXd t = rule_display(panel, letter_t(panel, 10), 0.15);
  for (std::size_t h = 0; h < panel.hinges.size(); ++h)
    EXPECT_DOUBLE_EQ(t[h], paper.hinges[h].parameters.t) << to_string(panel.hinges[h].wall);
}

TEST(HingeTies, PanelsLookTheSameAfterTheMotion) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.1, 0.9);
  for (const Symmetry symmetry :
       {Symmetry::none, Symmetry::mirror_x, Symmetry::mirror_y, Symmetry::rotate_2, Symmetry::rotate_4})
    for (const int side : {3, 4}) {
      const model::Structure panel = make_structure(model::rectangle(side, side), {});
      const HingeTies ties = hinge_ties(panel, symmetry);
      VectorXd x(ties.variables);
      for (double& value : x) value = any(random);
      const VectorXd t = ties.expand(x);
      EXPECT_LE((ties.nearest(t) - x).cwiseAbs().maxCoeff(), 1e-15);
      const auto turned = [&](Eigen::Vector2d p) -> Eigen::Vector2d {
        switch (symmetry) {
          case Symmetry::mirror_x:
            return {side - p.x(), p.y()};
          case Symmetry::mirror_y:
            return {p.x(), side - p.y()};
          case Symmetry::rotate_2:
            return {side - p.x(), side - p.y()};
          case Symmetry::rotate_4:
            return {side - p.y(), p.x()};
          case Symmetry::none:
            break;
        }
        return p;
      };
      const auto point = [&](std::size_t h) -> Eigen::Vector2d {
        const auto [i, j] = panel.hinges[h].wall.from;
        const bool along_x = panel.hinges[h].wall.axis == model::Axis::x;
        return Eigen::Vector2d(i, j) + t[h] * (along_x ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY());
      };
      for (std::size_t h = 0; h < panel.hinges.size(); ++h) {
        double nearest = 1;
        for (std::size_t other = 0; other < panel.hinges.size(); ++other)
          nearest = std::min(nearest, (turned(point(h)) - point(other)).norm());
        EXPECT_LE(nearest, 1e-12) << side << " cells, hinge " << h;
      }
    }
}

/// A mirror maps class A to class B when the number of cells is odd.
TEST(DisplaySearch, StartsOfTiedPanelsAreAsFarOffTheMiddleAsTheRule) {
  for (const int side : {5, 6}) {
    const model::Structure panel = make_structure(model::rectangle(side, side), {});
    const std::vector<double> levels = letter_t(panel, side);
    DisplayOptions options = pressed(0.1);
    options.symmetry = Symmetry::mirror_x;
    const DisplaySearch search(panel, levels, options, model::Axis::y);
    const double off = (search.start(0).array() - 0.5).abs().maxCoeff();
    EXPECT_NEAR(off, 0.5 - options.rule_k, 1e-12) << side;
  }
}

/// Hinges of walls that the symmetry turns end to end sit at 1 - t.
TEST(DisplayVariables, KeepTheRangeOnWallsThatAreTurnedEndToEnd) {
  const model::Structure panel = make_structure(model::rectangle(4, 4), {});
  for (const Symmetry symmetry :
       {Symmetry::none, Symmetry::mirror_x, Symmetry::mirror_y, Symmetry::rotate_2, Symmetry::rotate_4}) {
    const DisplayVariables variables = {hinge_ties(panel, symmetry), {0.3, 0.6}, {}};
    for (const VectorXd& t : {variables.t_of(variables.lower()), variables.t_of(variables.upper())}) {
      EXPECT_GE(t.minCoeff(), 0.3 - 1e-15) << static_cast<int>(symmetry);
      EXPECT_LE(t.maxCoeff(), 0.6 + 1e-15) << static_cast<int>(symmetry);
    }
  }
  const DisplayVariables turned = {hinge_ties(panel, Symmetry::rotate_2), {0.3, 0.6}, {}};
  EXPECT_NEAR(turned.lower().minCoeff(), 0.4, 1e-15);
  EXPECT_NEAR(turned.upper().maxCoeff(), 0.6, 1e-15);
}

TEST(PictureCost, DerivativesMatchCentralDifferences) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  for (const bool grey : {false, true}) {
    std::vector<double> levels(12), readings(12);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      levels[k] = grey ? any(random) : k % 3 == 0;
      readings[k] = any(random) + levels[k];
    }
    const PictureCost picture(levels);
    for (const bool contrast : {false, true}) {
      const auto weigh = [&](const VectorXd& x) {
        const std::vector<double> values(x.data(), x.data() + x.size());
        return contrast ? picture.for_contrast(values) : picture.for_separation(values, 0.2);
      };
      const VectorXd at = Eigen::Map<VectorXd>(readings.data(), 12);
      testing::expect_jacobian([&](const VectorXd& x) { return VectorXd::Constant(1, weigh(x).cost); }, at,
                               weigh(at).slope.transpose());
    }
  }
}

TEST(PictureCost, ContrastIsThatOfTheScore) {
  const std::vector<double> levels = {1, 1, 0, 0, 0}, readings = {3, 5, 0, 2, 3};
  EXPECT_NEAR(std::exp(-PictureCost(levels).for_contrast(readings).cost / 2),
              targets::display_score(readings, levels).contrast, 1e-9);
}

TEST(PictureCost, LeavesHolesOut) {
  const PictureCost picture({1, 0, 0, 1});
  const std::vector<double> readings = {0.9, 0.2, 0.3, 0.7};
  std::vector<double> with_holes = readings;
  with_holes.insert(with_holes.end(), {7, 1e300});
  for (const bool contrast : {false, true}) {
    const auto weigh = [&](const std::vector<double>& of) {
      return contrast ? picture.for_contrast(of) : picture.for_separation(of, 0.2);
    };
    EXPECT_EQ(weigh(with_holes).cost, weigh(readings).cost);
    EXPECT_EQ(weigh(with_holes).slope.head(4), weigh(readings).slope);
    EXPECT_EQ(weigh(with_holes).slope.tail(2), VectorXd::Zero(2));
  }
}

TEST(DisplayProblem, DerivativesMatchCentralDifferencesWithWallsInContact) {
  const model::Structure panel = make_structure(model::rectangle(5, 5), {});
  const std::vector<double> levels = letter_t(panel, 5);
  const DisplayVariables variables = {hinge_ties(panel, Symmetry::rotate_2), {0.05, 0.95}, {{0.1, 0.2}}};
  for (const Channel channel : {Channel::aperture, Channel::area, Channel::rotation}) {
    PanelEquilibrium equilibrium(panel, {}, pressed(0.16).plates);
    const PictureCost picture(levels);
    DisplayProblem problem(
        equilibrium, variables, channel, [&](const auto& r) { return picture.for_separation(r, 0.3); }, 0.05,
        1.0);
    VectorXd x = variables.nearest(rule_display(panel, levels, 0.2), 0.16);
    for (Eigen::Index k = 0; k + 1 < x.size(); ++k) x[k] += 0.01 * std::sin(static_cast<double>(k));
    double f = 0;
    VectorXd gradient;
    ASSERT_TRUE(problem.evaluate(x, f, &gradient));
    const auto value = [&](const VectorXd& at) {
      double cost = 0;
      EXPECT_TRUE(problem.evaluate(at, cost, nullptr));
      return VectorXd::Constant(1, cost);
    };
    testing::expect_jacobian(value, x, gradient.transpose(), 1e-6, 1e-5);
  }
}

TEST(DisplayProblem, DerivativesByOffsetsMatchCentralDifferences) {
  for (const bool honeycomb : {false, true}) {
    model::Lattice panel = model::make_sheet(4, 4, {});
    if (honeycomb) {
      model::LatticeSheet sheet{&model::honeycomb_lattice, model::lattice_cells(3, 3)};
      sheet.closed_boundary = true;
      panel = make_planar_structure(sheet, {});
    }
    std::vector<double> levels(honeycomb ? 9 : 16, 0.0);
    for (std::size_t c = 0; c < levels.size(); c += 3) levels[c] = 1;
    DisplayVariables variables{untied(panel.hinges()), {0.2, 0.8}, {{0.05, 0.2}}};
    variables.offset = 0.1;
    model::Plates plates = pressed(0.1).plates;
    if (honeycomb) plates.axis = model::Axis::x;
    PanelEquilibrium equilibrium(panel, {}, plates);
    const PictureCost picture(levels);
    DisplayProblem problem(
        equilibrium, variables, Channel::light,
        [&](const auto& readings) { return picture.for_separation(readings, 0.1); }, 0.002, 1.0);
    VectorXd x(variables.lower().size());
    for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = std::sin(static_cast<double>(3 * k));
    x.head(panel.hinges()) = 0.02 * x.head(panel.hinges()).array() + 0.5;
    x[panel.hinges()] = 0.1;
    x.tail(panel.hinges()) *= 0.02;
    double f = 0;
    VectorXd gradient;
    ASSERT_TRUE(problem.evaluate(x, f, &gradient)) << honeycomb;
    EXPECT_GT(gradient.tail(panel.hinges()).norm(), 1e-4);
    const auto value = [&](const VectorXd& at) {
      double cost = 0;
      EXPECT_TRUE(problem.evaluate(at, cost, nullptr));
      return VectorXd::Constant(1, cost);
    };
    testing::expect_jacobian(value, x, gradient.transpose(), 1e-6, 1e-5);
  }
}

TEST(RefineDisplay, BuysContrastByALittleStrain) {
  const model::Lattice panel = model::make_sheet(8, 8, {10, 0.8, 6});
  const std::vector<double> levels = letter_t(*panel.squares(), 8);
  DisplayOptions options;
  options.channel = Channel::light;
  options.offset = 0.08;
  options.stretch = 0.004;
  options.t = {0.2, 0.8};
  options.solver.max_evaluations = 40;
  const DisplayDesign exact = fit_scaled_display(panel, levels, Channel::light, {model::Axis::y}, {});
  DisplayDesign strained = exact;
  refine_display(panel, levels, options, strained);
  ASSERT_TRUE(strained.refined) << strained.why;
  EXPECT_GE(strained.view.score.contrast, 1.2 * exact.view.score.contrast);
  EXPECT_EQ(strained.view.score.auc, 1);
  EXPECT_LE(strained.view.stretch, options.stretch);
  EXPECT_GE(strained.view.stretch, 1e-4) << "it was not for nothing";
  EXPECT_LE(strained.view.offset.lpNorm<Eigen::Infinity>(), options.offset);
  EXPECT_GE(strained.view.t.minCoeff(), 0.2);
  EXPECT_LE(strained.view.t.maxCoeff(), 0.8);
}

void expect_unblurred_letter(int cells, int evaluations) {
  const model::Structure panel = make_structure(model::rectangle(cells, cells), {});
  DisplayOptions options = pressed(0.12);
  options.starts = 2;
  options.solver.max_evaluations = evaluations;
  const DisplayDesign design = fit_display(panel, letter_t(panel, cells), options);
  ASSERT_EQ(design.starts.size(), 2u);
  EXPECT_LT(design.starts[0].view.score.auc, 0.96);
  ASSERT_TRUE(design.view.at_equilibrium);
  EXPECT_EQ(design.view.score.auc, 1);
  EXPECT_GE(design.view.score.contrast, 6);
  EXPECT_GE(design.view.score.separation(), 0.075);
  EXPECT_LE(design.view.stretch, 0.12);
  EXPECT_GE(design.view.t.minCoeff(), 0.08);
  EXPECT_LE(design.view.t.maxCoeff(), 0.92);
}

TEST(FitDisplay, ShowsALetterThatTheRuleAloneBlurs) { expect_unblurred_letter(6, 30); }

TEST(FitDisplaySoak, ShowsALetterThatTheRuleAloneBlurs) { expect_unblurred_letter(10, 60); }

TEST(FitDisplay, SameAnswerForAnyNumberOfThreads) {
  const model::Structure panel = make_structure(model::rectangle(4, 4), {});
  const std::vector<double> levels = letter_t(panel, 4);
  DisplayOptions options = pressed(0.1);
  options.starts = 4;
  options.seed = 5;
  options.solver.max_evaluations = 10;
  options.threads = 1;
  const DisplayDesign first = fit_display(panel, levels, options);
  options.threads = 3;
  const DisplayDesign second = fit_display(panel, levels, options);
  EXPECT_EQ(first.view.t, second.view.t);
  for (std::size_t k = 0; k < first.starts.size(); ++k)
    EXPECT_EQ(first.starts[k].cost, second.starts[k].cost) << k;
}

TEST(FitDisplay, StartsFromTheRuleThenHalfOfItThenAtRandomBySeed) {
  const model::Structure panel = make_structure(model::rectangle(4, 4), {});
  const std::vector<double> levels = letter_t(panel, 4);
  DisplayOptions options = pressed(0.1);
  options.seed = 1;
  const DisplaySearch search(panel, levels, options, model::Axis::x);
  EXPECT_EQ(search.start(0), rule_display(panel, levels, 0.15));
  EXPECT_EQ(search.start(1), rule_display(panel, levels, 0.85));
  EXPECT_LE((search.start(3) - rule_display(panel, levels, 0.675)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(search.name_of_start(2), "rule k = 0.325, plates along x");
  const VectorXd shifted = search.start(4) - search.start(0);
  EXPECT_LE(shifted.cwiseAbs().maxCoeff(), 0.08);
  EXPECT_GE(shifted.cwiseAbs().minCoeff(), 1e-6);
  DisplayOptions other = options;
  other.seed = 2;
  EXPECT_GE((search.start(4) - DisplaySearch(panel, levels, other, model::Axis::x).start(4)).norm(), 0.01);
}

TEST(FitDisplay, CompressionAndDirectionAreVariablesToo) {
  const model::Structure panel = make_structure(model::rectangle(6, 4), {});
  std::vector<double> levels;
  for (const auto& [i, j] : panel.cells) levels.push_back(i > 0 && i < 5 && j > 0 && j < 3 ? 1 : 0);
  DisplayOptions options = pressed(0.06);
  options.starts = 2;
  options.solver.max_evaluations = 40;
  const DisplayDesign fixed = fit_display(panel, levels, options);
  options.axes = {model::Axis::y, model::Axis::x};
  options.compression = {{0.04, 0.16}};
  const DisplayDesign free = fit_display(panel, levels, options);
  ASSERT_TRUE(fixed.view.at_equilibrium && free.view.at_equilibrium);
  ASSERT_EQ(free.starts.size(), 4u);
  EXPECT_EQ(free.starts[0].view.plates.axis, model::Axis::y);
  EXPECT_EQ(free.starts[2].view.plates.axis, model::Axis::x);
  EXPECT_EQ(fixed.view.plates.compression, 0.06);
  EXPECT_GT(std::abs(free.view.plates.compression - 0.06), 1e-3);
  EXPECT_GE(free.view.plates.compression, 0.04);
  EXPECT_LE(free.view.plates.compression, 0.16);
  // Either search may stop in the better of many designs.
  for (const DisplayDesign& found : {fixed, free}) EXPECT_GT(found.view.score.contrast, 20);
}

/// The picture requires more than the hinges may stretch: a panel pressed far, and a limit below the stretch of a
/// search without it.
TEST(FitDisplay, KeepsTheLimitOfStretch) {
  const model::Structure panel = make_structure(model::rectangle(5, 5), {});
  std::vector<double> levels;
  for (const auto& [i, j] : panel.cells) levels.push_back((i + 2 * j) % 3 == 0 ? 1 : 0);
  DisplayOptions options = pressed(0.12);
  options.starts = 1;
  options.solver.max_evaluations = 40;
  options.stretch = 1;
  EXPECT_GT(fit_display(panel, levels, options).view.stretch, 0.06);
  options.stretch = 0.06;
  const DisplayDesign design = fit_display(panel, levels, options);
  ASSERT_TRUE(design.view.at_equilibrium);
  EXPECT_LE(design.view.stretch, 0.06);
  EXPECT_GT(design.view.score.auc, 0.9);
}

TEST(BestView, IsTheClearestOfThoseThatKeepTheLimit) {
  const std::vector<double> levels = {1, 1, 0, 0};
  const auto view = [](std::vector<double> channel, double stretch) {
    DisplayView made;
    made.channel = std::move(channel);
    made.stretch = stretch;
    made.at_equilibrium = true;
    return made;
  };
  const DisplayView sharp = view({0.9, 0.91, 0.1, 0.11}, 0.2), fair = view({0.8, 0.9, 0.1, 0.2}, 0.1),
                    blurred = view({0.5, 0.9, 0.1, 0.4}, 0.05);
  EXPECT_EQ(best_view({sharp, blurred, fair}, levels, 0.12), 2);
  EXPECT_EQ(best_view({sharp, blurred, fair}, levels, 0.3), 0);
  EXPECT_EQ(best_view({sharp, fair}, levels, 0.01), 1);
  EXPECT_EQ(best_view({DisplayView{}, fair}, levels, 0.01), 1);
  EXPECT_EQ(best_view({DisplayView{}}, levels, 0.12), -1);
}

TEST(FitDisplay, APlainPanelShowsNothing) {
  const model::Structure panel = make_structure(model::rectangle(6, 6), {});
  const DisplayView view = view_display(panel, letter_t(panel, 6), pressed(0.1));
  ASSERT_TRUE(view.at_equilibrium);
  EXPECT_LE(std::abs(view.score.separation()), 1e-4);
}

TEST(ScalarSolver, RefusesMethodsWithoutGradients) {
  struct Plain : ScalarProblem {
    VectorXd low = VectorXd::Zero(1), high = VectorXd::Ones(1);
    const VectorXd& lower() const override { return low; }
    const VectorXd& upper() const override { return high; }
    bool evaluate(const VectorXd& x, double& f, VectorXd* gradient) override {
      if (x[0] > 0.6) return false;
      f = (x[0] - 0.5) * (x[0] - 0.5);
      if (gradient) *gradient = VectorXd::Constant(1, 2 * (x[0] - 0.5));
      return true;
    }
  } problem;
  SolverOptions options;
  options.name = SolverName::bobyqa;
  EXPECT_THROW(solve(problem, VectorXd::Zero(1), options), InvalidInput);
  for (const SolverName name : {SolverName::mma, SolverName::ccsa, SolverName::slsqp}) {
    options.name = name;
    const ScalarResult found = solve(problem, VectorXd::Zero(1), options);
    EXPECT_NEAR(found.x[0], 0.5, 1e-3) << to_string(name);
    EXPECT_EQ(solve(problem, VectorXd::Ones(1), options).status, SolveStatus::cannot_evaluate);
  }
}

}  // namespace
}  // namespace kinetix::optim
