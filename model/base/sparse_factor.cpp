#include "model/base/sparse_factor.hpp"

#include <Eigen/SparseCholesky>

namespace kinetix {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

struct SparseFactor::Factor {
  Eigen::SimplicialLDLT<SparseMatrix> ldlt;
};

SparseFactor::SparseFactor() : factor_(std::make_unique<Factor>()) {}
SparseFactor::SparseFactor(const SparseMatrix& A) : SparseFactor() { compute(A); }
SparseFactor::~SparseFactor() = default;
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;
SparseFactor& SparseFactor::operator=(SparseFactor&&) noexcept = default;

void SparseFactor::analyze(const SparseMatrix& A) { factor_->ldlt.analyzePattern(A); }

bool SparseFactor::factorize(const SparseMatrix& A) {
  factor_->ldlt.factorize(A);
  return factor_->ldlt.info() == Eigen::Success;
}

bool SparseFactor::compute(const SparseMatrix& A) {
  analyze(A);
  return factorize(A);
}

VectorXd SparseFactor::solve(const VectorXd& b) const { return factor_->ldlt.solve(b); }
MatrixXd SparseFactor::solve_all(const MatrixXd& columns) const { return factor_->ldlt.solve(columns); }

}  // namespace kinetix
