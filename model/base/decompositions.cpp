#include "model/base/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

namespace kinetix {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) { return A.colPivHouseholderQr().solve(b); }

MatrixXd column_space(const MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  return qr.householderQ() * MatrixXd::Identity(A.rows(), qr.rank());
}

MatrixXd orthonormal(const MatrixXd& A) {
  const Eigen::HouseholderQR<MatrixXd> qr(A);
  return qr.householderQ() * MatrixXd::Identity(A.rows(), A.cols());
}

SingularVectors right_singular_vectors(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixV(), svd.singularValues()};
}

Eigenvectors symmetric_eigenvectors(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(A);
  return {solver.eigenvectors(), solver.eigenvalues(), solver.info() == Eigen::Success};
}

VectorXd symmetric_eigenvalues(const MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

PrincipalAxes principal_axes(const Eigen::Matrix3d& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(A);
  return {solver.eigenvectors(), solver.eigenvalues()};
}

struct SymmetricFactor::Factor {
  Eigen::LDLT<MatrixXd> ldlt;
};

SymmetricFactor::SymmetricFactor(const MatrixXd& A)
    : factor_(std::make_unique<Factor>(Factor{Eigen::LDLT<MatrixXd>(A)})) {}
SymmetricFactor::~SymmetricFactor() = default;

double SymmetricFactor::min_pivot() const { return factor_->ldlt.vectorD().minCoeff<Eigen::PropagateNaN>(); }
VectorXd SymmetricFactor::solve(const VectorXd& b) const { return factor_->ldlt.solve(b); }

VectorXd SymmetricFactor::inverse_diagonal() const {
  const Eigen::Index n = factor_->ldlt.rows();
  return factor_->ldlt.solve(MatrixXd::Identity(n, n)).diagonal();
}

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
