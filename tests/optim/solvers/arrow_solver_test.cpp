#include "optim/solvers/arrow_solver.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "optim/solvers/solver.hpp"

namespace kinetix::optim {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Points on two lines of one slope: shared slope, an offset a part; and one residual that holds the slope.
class ParallelLines final : public ArrowProblem {
 public:
  explicit ParallelLines(double max_slope) {
    lower_ = VectorXd::Constant(3, -std::numeric_limits<double>::infinity());
    upper_ = -lower_;
    upper_[0] = max_slope;
  }
  int shared() const override { return 1; }
  const std::vector<int>& parts() const override { return parts_; }
  const VectorXd& lower() const override { return lower_; }
  const VectorXd& upper() const override { return upper_; }
  const std::vector<int>& residuals() const override { return residuals_; }
  bool evaluate(const VectorXd& x, bool, std::vector<ResidualBlock>& blocks) const override {
    if (!(x[0] > -1)) return false;
    blocks.resize(3);
    for (int part = 0; part < 2; ++part) {
      ResidualBlock& block = blocks[part];
      block.r.resize(3);
      block.by_shared.resize(3, 1);
      block.by_local = MatrixXd::Ones(3, 1);
      for (int k = 0; k < 3; ++k) {
        block.r[k] = x[0] * k + x[1 + part] - (2.0 * k + 5 * part);
        block.by_shared(k, 0) = k;
      }
    }
    blocks[2] = {VectorXd::Constant(1, x[0] * x[0] - 4), MatrixXd::Constant(1, 1, 2 * x[0]), MatrixXd(1, 0)};
    return true;
  }

 private:
  std::vector<int> parts_ = {1, 1}, residuals_ = {3, 3, 1};
  VectorXd lower_, upper_;
};

TEST(ArrowSolver, FindsWhatPartsShareAndWhatIsTheirOwn) {
  const SolveResult found = solve(ParallelLines(10), VectorXd::Zero(3), {.tolerance = 1e-12});
  EXPECT_EQ(found.status, SolveStatus::converged);
  EXPECT_NEAR(found.x[0], 2, 1e-8);
  EXPECT_NEAR(found.x[1], 0, 1e-8);
  EXPECT_NEAR(found.x[2], 5, 1e-8);
  EXPECT_NEAR(found.residual_norm, 0, 1e-8);
}

TEST(ArrowSolver, KeepsBounds) {
  const SolveResult found = solve(ParallelLines(1.5), VectorXd::Zero(3), {.tolerance = 1e-12});
  EXPECT_NEAR(found.x[0], 1.5, 1e-9);
  EXPECT_NEAR(found.x[1], 0.5, 1e-8);
  EXPECT_LE(found.x[0], 1.5);
}

TEST(ArrowSolver, SaysWhereItCannotEvaluate) {
  const SolveResult found = solve(ParallelLines(-2), VectorXd::Zero(3), {});
  EXPECT_EQ(found.status, SolveStatus::cannot_evaluate);
}

TEST(ArrowSolver, StopsAtItsLimitOfEvaluations) {
  const SolveResult found = solve(ParallelLines(10), VectorXd::Zero(3), {.max_evaluations = 1});
  EXPECT_EQ(found.status, SolveStatus::evaluation_limit);
  EXPECT_EQ(found.x, VectorXd::Zero(3));
}

TEST(ArrowProblem, StacksItsBlocks) {
  const ParallelLines lines(10);
  std::vector<ResidualBlock> blocks;
  lines.evaluate(VectorXd::Constant(3, 1), true, blocks);
  const StackedResiduals all = stacked(lines, blocks);
  ASSERT_EQ(all.r.size(), 7);
  ASSERT_EQ(all.J.cols(), 3);
  EXPECT_EQ(all.J.row(4), Eigen::RowVector3d(1, 0, 1));
  EXPECT_EQ(all.J.row(6), Eigen::RowVector3d(2, 0, 0));
}

}  // namespace
}  // namespace kinetix::optim
