#include "model/base/sparse_factor.hpp"

#include <gtest/gtest.h>

namespace kinetix::testing {
namespace {

using Eigen::VectorXd;
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
