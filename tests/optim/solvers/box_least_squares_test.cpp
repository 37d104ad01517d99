#include "optim/solvers/box_least_squares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();  // a bound that never holds

Eigen::SparseMatrix<double> identity(int size) {
  return MatrixXd(MatrixXd::Identity(size, size)).sparseView();
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  VectorXd vector(int size) {
    return VectorXd::NullaryExpr(size, [&] { return by_(engine_); });
  }
  MatrixXd matrix(int rows, int columns) {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return by_(engine_); });
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> by_{-1, 1};
};

/// u itself within bounds: the answer is the clamped one.
BoxLeastSquares clamped(int size, unsigned seed) {
  Random random(seed);
  return {.A = identity(size),
          .b = 3 * random.vector(size),
          .C = identity(size),
          .lower = random.vector(size).array() - 1.0,
          .upper = random.vector(size).array() + 1.0,
          .from = VectorXd::Zero(size)};
}

BoxLeastSquares random_problem(unsigned seed, int rows = 30, int unknowns = 20, int bounds = 25) {
  Random random(seed);
  const VectorXd inside = 0.3 * random.vector(bounds);
  return {.A = random.matrix(rows, unknowns).sparseView(),
          .b = 3 * random.vector(rows),
          .C = random.matrix(bounds, unknowns).sparseView(),
          .lower = inside.array() - 0.5,
          .upper = inside.array() + 0.5,
          .damping = 1e-2,
          .from = random.vector(unknowns)};
}

/// Returns the slope of half the cost at u.
VectorXd slope(const BoxLeastSquares& p, const VectorXd& u) {
  return p.A.transpose() * (p.A * u - p.b) + p.damping * (u - p.from);
}

TEST(BoxLeastSquares, ClampsWhatIsBoundedByItself) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    BoxLeastSquares p = clamped(12, seed);
    const BoxLeastSquaresResult found = solve_box_least_squares(p, {.settled = 1e-10});
    EXPECT_TRUE(found.converged) << "seed " << seed;
    const VectorXd free = (p.b + p.damping * p.from) / (1 + p.damping);
    const VectorXd expected = free.cwiseMax(p.lower).cwiseMin(p.upper);
    EXPECT_LE((found.u - expected).cwiseAbs().maxCoeff(), 1e-9) << "seed " << seed;
  }
}

TEST(BoxLeastSquares, IsPlainLeastSquaresWhereNoBoundHolds) {
  BoxLeastSquares p = random_problem(4);
  p.lower.setConstant(-infinity);
  p.upper.setConstant(infinity);
  const MatrixXd A = p.A;
  const MatrixXd normal = A.transpose() * A + p.damping * MatrixXd::Identity(A.cols(), A.cols());
  const VectorXd expected = normal.ldlt().solve(A.transpose() * p.b + p.damping * p.from);
  const BoxLeastSquaresResult found = solve_box_least_squares(p, {.settled = 1e-11});
  EXPECT_TRUE(found.converged);
  EXPECT_LE((found.u - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(BoxLeastSquares, MeetsEqualBoundsExactly) {
  BoxLeastSquares p = random_problem(5, 30, 20, 6);
  p.upper = p.lower;
  const BoxLeastSquaresResult found = solve_box_least_squares(p, {.settled = 1e-10});
  EXPECT_TRUE(found.converged);
  EXPECT_LE((p.C * found.u - p.lower).cwiseAbs().maxCoeff(), 1e-9);
}

// The slope is held by the bounds alone: C^T dual = -slope, with a dual that pushes inwards, and only where u
// is at a bound.
TEST(BoxLeastSquares, IsHeldByTheBoundsThatItIsAt) {
  for (unsigned seed = 10; seed < 30; ++seed) {
    const BoxLeastSquares p = random_problem(seed);
    const BoxLeastSquaresResult found =
        solve_box_least_squares(p, {.settled = 1e-10, .most_iterations = 40000});
    ASSERT_TRUE(found.converged) << "seed " << seed;
    EXPECT_LE(found.excess, 1e-10);
    const VectorXd dual = found.memory.penalty * found.memory.dual, value = p.C * found.u;
    EXPECT_LE((slope(p, found.u) + p.C.transpose() * dual).cwiseAbs().maxCoeff(), 1e-6) << "seed " << seed;
    for (int k = 0; k < value.size(); ++k) {
      const double held = dual[k] > 1e-6 ? p.upper[k] : dual[k] < -1e-6 ? p.lower[k] : value[k];
      EXPECT_NEAR(value[k], held, 1e-9) << "seed " << seed;
      EXPECT_GE(value[k], p.lower[k] - 1e-9);
      EXPECT_LE(value[k], p.upper[k] + 1e-9);
    }
  }
}

TEST(BoxLeastSquares, GoesOnFromMemoryToTheSameAnswerInFewerSteps) {
  for (unsigned seed = 40; seed < 45; ++seed) {
    const BoxLeastSquaresOptions options{.settled = 1e-9, .most_iterations = 40000};
    BoxLeastSquares p = random_problem(seed);
    const BoxLeastSquaresResult first = solve_box_least_squares(p, options);
    p.b *= 1.001;
    const BoxLeastSquaresResult anew = solve_box_least_squares(p, options);
    const BoxLeastSquaresResult on = solve_box_least_squares(p, options, &first.memory);
    ASSERT_TRUE(first.converged && anew.converged && on.converged) << "seed " << seed;
    EXPECT_LE((on.u - anew.u).cwiseAbs().maxCoeff(), 1e-6) << "seed " << seed;
    EXPECT_LT(on.iterations, anew.iterations) << "seed " << seed;
  }
}

TEST(BoxLeastSquares, StartsAnewFromAMemoryOfAnotherProblem) {
  const BoxLeastSquaresResult other = solve_box_least_squares(clamped(3, 1));
  const BoxLeastSquares p = random_problem(50);
  EXPECT_EQ(solve_box_least_squares(p, {}, &other.memory).u, solve_box_least_squares(p).u);
}

TEST(BoxLeastSquares, SaysWhereItHasNotConverged) {
  EXPECT_FALSE(solve_box_least_squares(random_problem(60), {.most_iterations = 3}).converged);
  BoxLeastSquares impossible = clamped(2, 1);
  impossible.C = MatrixXd(MatrixXd::Ones(2, 2)).sparseView();
  impossible.lower = VectorXd{{0.0, 1.0}};
  impossible.upper = VectorXd{{0.0, 1.0}};
  const BoxLeastSquaresResult found = solve_box_least_squares(impossible);
  EXPECT_FALSE(found.converged) << "one sum cannot be 0 and 1";
  EXPECT_NEAR(found.excess, 0.5, 1e-3);
}

TEST(BoxLeastSquares, RefusesWhatIsNoProblem) {
  const BoxLeastSquares good = clamped(4, 1);
  const auto refused = [&](auto&& spoil) {
    BoxLeastSquares p = good;
    spoil(p);
    EXPECT_THROW(solve_box_least_squares(p), InvalidInput);
  };
  const double nan = std::nan("");
  refused([](auto& p) { p.b = VectorXd::Zero(3); });
  refused([](auto& p) { p.from = VectorXd::Zero(5); });
  refused([](auto& p) { p.lower = VectorXd::Zero(3); });
  refused([](auto& p) { p.C = identity(3); });
  refused([](auto& p) { p.lower[1] = p.upper[1] + 1; });
  refused([&](auto& p) { p.lower[1] = nan; });
  refused([&](auto& p) { p.b[1] = nan; });
  refused([&](auto& p) { p.from[1] = infinity; });
  refused([&](auto& p) { p.A.coeffRef(1, 1) = nan; });
  refused([&](auto& p) { p.C.coeffRef(1, 1) = infinity; });
  refused([](auto& p) { p.damping = 0; });
  refused([&](auto& p) { p.damping = nan; });
}

}  // namespace
}  // namespace kinetix::optim
