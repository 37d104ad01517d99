#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace kinetix {

// Dense decompositions by Eigen, in one file because each takes seconds to compile.

/// Returns the x that minimises |A x - b|, by a QR factor with column pivoting.
/// @param A one row per entry of b, at least as many rows as columns; x is unique only for full column rank
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Returns an orthonormal basis of the column space of A. The number of columns is the numerical rank of A.
Eigen::MatrixXd column_space(const Eigen::MatrixXd& A);

/// Returns orthonormal columns that span those of A, one per column of A. @pre rows >= columns
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A);

/// Right singular vectors (orthonormal columns) and singular values, largest first: min(rows, columns) of
/// each.
struct SingularVectors {
  Eigen::MatrixXd vectors;  ///< dimensionless
  Eigen::VectorXd values;   ///< of the unit of A
};
SingularVectors right_singular_vectors(const Eigen::MatrixXd& A);

/// Eigenvalues of a symmetric matrix, least first, and their vectors, orthonormal columns.
struct Eigenvectors {
  Eigen::MatrixXd vectors;  ///< dimensionless
  Eigen::VectorXd values;   ///< of the unit of A
  bool converged = false;
};
Eigenvectors symmetric_eigenvectors(const Eigen::MatrixXd& A);

/// Returns the eigenvalues of a symmetric matrix without their vectors, least first, in the unit of A.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);

/// Eigenvalues and orthonormal eigenvectors of a symmetric 3 x 3 matrix, such as an inertia or a stiffness.
struct PrincipalAxes {
  Eigen::Matrix3d axes;    ///< orthonormal columns, dimensionless
  Eigen::Vector3d values;  ///< of the unit of A, least first
};
PrincipalAxes principal_axes(const Eigen::Matrix3d& A);

/// LDL^T factor of a symmetric positive matrix, with the largest pivots first.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(const Eigen::MatrixXd& A);
  ~SymmetricFactor();

  /// Returns the smallest pivot, in the unit of A; NaN if A is not finite.
  double min_pivot() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::VectorXd inverse_diagonal() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

/// LDL^T factor of a sparse symmetric matrix, by Eigen without supernodes. It is in one file because it takes
/// seconds to compile. Only the lower half of a matrix is read.
class SparseFactor {
 public:
  SparseFactor();
  explicit SparseFactor(const Eigen::SparseMatrix<double>& A);
  ~SparseFactor();
  SparseFactor(SparseFactor&&) noexcept;
  SparseFactor& operator=(SparseFactor&&) noexcept;

  /// Computes the ordering of the unknowns from the pattern of A, for all later calls of `factorize`.
  void analyze(const Eigen::SparseMatrix<double>& A);
  /// Factorises A, whose pattern must be the analysed one. @return whether that succeeded: no pivot is zero
  bool factorize(const Eigen::SparseMatrix<double>& A);
  /// Analyses the pattern of A and factorises it. @return as factorize()
  bool compute(const Eigen::SparseMatrix<double>& A);

  /// @pre the last factorisation succeeded
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_all(const Eigen::MatrixXd& columns) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace kinetix
