#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "model/base/decompositions.hpp"

namespace kinetix::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns 1, x, and 2 + 3 x where asked for.
MatrixXd line_rows(int columns) {
  MatrixXd A(5, columns);
  for (int k = 0; k < 5; ++k)
    for (int c = 0; c < columns; ++c) A(k, c) = c == 0 ? 1 : c == 1 ? k : 2 + 3 * k;
  return A;
}

TEST(Decompositions, FitALineToItsPoints) {
  const MatrixXd A = line_rows(2);
  const VectorXd x = least_squares(A, A * Eigen::Vector2d(0.5, -2));
  EXPECT_NEAR(x[0], 0.5, 1e-13);
  EXPECT_NEAR(x[1], -2, 1e-13);
}

TEST(Decompositions, FindAsManyColumnsAsTheRank) {
  const MatrixXd A = line_rows(3), Q = column_space(A);
  ASSERT_EQ(Q.cols(), 2);
  EXPECT_TRUE((Q.transpose() * Q).isIdentity(1e-14));
  EXPECT_LT((A - Q * Q.transpose() * A).norm(), 1e-13);
  EXPECT_EQ(orthonormal(line_rows(2)).cols(), 2);
}

TEST(Decompositions, GiveSingularValuesOfATurnedStretch) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  MatrixXd turn(2, 2);
  turn << c, -s, s, c;
  const MatrixXd A = turn * Eigen::Vector2d(3, 0.5).asDiagonal() * turn.transpose();
  const SingularVectors found = right_singular_vectors(A);
  EXPECT_NEAR(found.values[0], 3, 1e-14);
  EXPECT_NEAR(found.values[1], 0.5, 1e-14);
  EXPECT_NEAR(std::abs(found.vectors.col(0).dot(turn.col(0))), 1, 1e-14);
}

TEST(Decompositions, OfASymmetricMatrixAreByHand) {
  MatrixXd A(2, 2);
  A << 2, 1, 1, 2;  // eigenvalues 1 and 3; inverse [[2, -1], [-1, 2]] / 3
  const Eigenvectors found = symmetric_eigenvectors(A);
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.values[0], 1, 1e-14);
  EXPECT_NEAR(found.values[1], 3, 1e-14);
  const SymmetricFactor factor(A);
  EXPECT_NEAR(factor.min_pivot(), 1.5, 1e-14);
  EXPECT_TRUE(factor.inverse_diagonal().isApprox(VectorXd::Constant(2, 2.0 / 3), 1e-14));
  EXPECT_TRUE(factor.solve(Eigen::Vector2d(3, 0)).isApprox(Eigen::Vector2d(2, -1), 1e-14));
}

TEST(Decompositions, OfWhatIsNoNumberHaveNoPivot) {
  EXPECT_FALSE(
      SymmetricFactor(MatrixXd::Constant(2, 2, std::numeric_limits<double>::quiet_NaN())).min_pivot() > 0);
  EXPECT_EQ(SymmetricFactor(MatrixXd::Ones(2, 2)).min_pivot(), 0);
}

using SparseMatrix = Eigen::SparseMatrix<double>;

/// A string of n beads between walls: second differences.
SparseMatrix beads(int n, double middle) {
  SparseMatrix A(n, n);
  for (int k = 0; k < n; ++k) {
    A.insert(k, k) = middle;
    if (k > 0) A.insert(k, k - 1) = A.insert(k - 1, k) = -1;
  }
  return A;
}

TEST(SparseFactor, HangsAStringOfBeadsInAParabola) {
  constexpr int n = 40;  // beads: k (n + 1 - k) / 2 under unit loads
  const SparseFactor factor(beads(n, 2));
  const VectorXd x = factor.solve(VectorXd::Ones(n));
  for (int k = 1; k <= n; ++k) EXPECT_NEAR(x[k - 1], 0.5 * k * (n + 1 - k), 1e-11) << k;
  EXPECT_TRUE(factor.solve_all(Eigen::MatrixXd::Ones(n, 2)).col(1).isApprox(x, 1e-14));
}

TEST(SparseFactor, KeepsItsOrderForMatricesOfOnePattern) {
  SparseFactor factor;
  factor.analyze(beads(9, 2));
  for (const double middle : {2.0, 3.0}) {
    const SparseMatrix A = beads(9, middle);
    ASSERT_TRUE(factor.factorize(A));
    EXPECT_TRUE((A * factor.solve(VectorXd::Ones(9))).isOnes(1e-13)) << middle;
  }
}

TEST(SparseFactor, SaysThatAMatrixHasNone) {
  SparseFactor factor;
  EXPECT_FALSE(factor.compute(SparseMatrix(3, 3)));
  EXPECT_TRUE(factor.compute(beads(3, 2)));
}

}  // namespace
}  // namespace kinetix::testing
