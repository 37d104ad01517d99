#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace kinetix {

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
