#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace kinetix {

/// LDL^T factor of a sparse symmetric matrix, by Eigen without supernodes; in one place because it takes a compiler
/// seconds. Only the lower half of a matrix is read.
class SparseFactor {
 public:
  SparseFactor();
  explicit SparseFactor(const Eigen::SparseMatrix<double>& A);
  ~SparseFactor();
  SparseFactor(SparseFactor&&) noexcept;
  SparseFactor& operator=(SparseFactor&&) noexcept;

  /// Orders the unknowns by the pattern of A, for all matrices that `factorize` is then given.
  void analyze(const Eigen::SparseMatrix<double>& A);
  /// @return whether A, of the pattern known, has a factor: no pivot is zero
  bool factorize(const Eigen::SparseMatrix<double>& A);
  /// Both of it.
  bool compute(const Eigen::SparseMatrix<double>& A);

  /// @pre the last matrix had a factor
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_all(const Eigen::MatrixXd& columns) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace kinetix
