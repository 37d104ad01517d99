#pragma once

#include <Eigen/Core>
#include <memory>

namespace kinetix {

// Dense decompositions by Eigen, in one place because each takes a compiler seconds.

/// The x that makes |A x - b| least, by a QR factor with column pivoting.
/// @param A as many rows as b, at least as many as columns; of full column rank, or x is one of many
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Orthonormal columns that span those of A; as many as its rank, to rounding.
Eigen::MatrixXd column_space(const Eigen::MatrixXd& A);

/// Orthonormal columns that span those of A, as many as it has. @pre rows >= columns
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A);

/// Right singular vectors, orthonormal columns, with their values, largest first; min(rows, columns) of each.
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

/// Those values alone, of the unit of A.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);

/// The same in space: of a spread, an inertia, a stiffness.
struct PrincipalAxes {
  Eigen::Matrix3d axes;    ///< orthonormal columns, dimensionless
  Eigen::Vector3d values;  ///< of the unit of A, least first
};
PrincipalAxes principal_axes(const Eigen::Matrix3d& A);

/// LDL^T factor of a symmetric positive matrix, its largest pivots first.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(const Eigen::MatrixXd& A);
  ~SymmetricFactor();

  /// Of the unit of A; NaN where A is not finite.
  double least_pivot() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::VectorXd inverse_diagonal() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace kinetix
