#include "model/base/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

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

double SymmetricFactor::least_pivot() const {
  return factor_->ldlt.vectorD().minCoeff<Eigen::PropagateNaN>();
}
VectorXd SymmetricFactor::solve(const VectorXd& b) const { return factor_->ldlt.solve(b); }

VectorXd SymmetricFactor::inverse_diagonal() const {
  const Eigen::Index n = factor_->ldlt.rows();
  return factor_->ldlt.solve(MatrixXd::Identity(n, n)).diagonal();
}

}  // namespace kinetix
