#include <gtest/gtest.h>
#include <algorithm>
#include <random>

#include "optim/display/display_reading.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::optim {
namespace {

// Counts: enough that one cell or error alone does not decide.
constexpr int cells = 60, errors = 40;

struct Panel {
  std::vector<double> readings, levels;
  Eigen::MatrixXd derivatives{cells, errors};
};

Panel panel(double scatter) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  Panel p;
  for (int k = 0; k < cells; ++k) {
    p.levels.push_back(k % 3 == 0);
    p.readings.push_back(0.1 * (k % 3 == 0) + 0.03 * normal(random));
  }
  for (double& entry : p.derivatives.reshaped()) entry = scatter * normal(random);
  return p;
}

// Readings drawn from the distribution that it assumes.
TEST(DisplayTolerance, IsWhatManyPrintsShow) {
  for (const double scatter : {0.002, 0.006}) {
    const Panel p = panel(scatter);
    const DisplayTolerance made = analyse_display_tolerance(p.readings, p.levels, p.derivatives);
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, 1);
    constexpr int prints = 4000;
    std::vector<double> contrasts;
    double mean = 0, auc = 0;
    for (int k = 0; k < prints; ++k) {
      Eigen::VectorXd e(errors);
      for (double& entry : e) entry = normal(random);
      const Eigen::VectorXd moved = p.derivatives * e;
      std::vector<double> readings = p.readings;
      for (int c = 0; c < cells; ++c) readings[c] += moved[c];
      const targets::DisplayScore score = targets::display_score(readings, p.levels);
      contrasts.push_back(score.contrast);
      mean += score.contrast / prints;
      auc += score.auc / prints;
    }
    std::sort(contrasts.begin(), contrasts.end());
    EXPECT_NEAR(made.contrast, mean, 0.03 * mean);
    EXPECT_NEAR(made.contrast_p05, contrasts[prints / 20], 0.05 * mean);
    EXPECT_NEAR(made.auc, auc, 0.005);
  }
}

TEST(DisplayTolerance, OfExactPrintsIsTheDesign) {
  const Panel p = panel(0);
  const DisplayTolerance made = analyse_display_tolerance(p.readings, p.levels, p.derivatives);
  const targets::DisplayScore score = targets::display_score(p.readings, p.levels);
  EXPECT_NEAR(made.contrast, score.contrast, 1e-9);
  EXPECT_NEAR(made.contrast_p05, score.contrast, 1e-9);
  EXPECT_NEAR(made.auc, score.auc, 1e-12);
}

}  // namespace
}  // namespace kinetix::optim
