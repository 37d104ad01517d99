#pragma once

#include <Eigen/SparseCore>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "model/elastic/dof_map.hpp"
#include "model/hinge/element.hpp"

namespace kinetix::model {

/// The sparse symmetric matrix of second derivatives by the unknowns, and its Cholesky factor. Made of 6 x 6
/// blocks of pairs of bodies, in units of k_point edge^2; the symbolic factorisation is reused until a new
/// pair comes in.
class TangentStiffness {
 public:
  explicit TangentStiffness(const DofMap& dofs);
  ~TangentStiffness();

  void clear();
  /// @param a, b the element's bodies, different
  void add(int a, int b, const Element& element);
  /// Second derivatives by the coordinates of several bodies, six a body, together.
  /// @param bodies ascending, different
  void add(const std::vector<int>& bodies, const Eigen::MatrixXd& hessian);

  /// Factorises the matrix plus `shift` times the identity. @return whether that is positive definite
  bool factorise(double shift);
  /// Whether the last factorise succeeded: of this matrix, or of one before clear().
  bool is_factorised() const { return factorised_; }
  /// Calls of factorise so far: where none came in between, the factor is still the one that it was.
  long factors() const { return factors_; }
  /// @pre is_factorised()
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;
  Eigen::VectorXd multiply(const Eigen::VectorXd& x);
  /// The block of rows of all coordinates of body a, columns of those of body b, held ones included.
  Eigen::VectorXd multiply_all(const Eigen::VectorXd& all) const;

  int size() const { return dofs_.count; }
  /// Lower triangle, of the last factorise.
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  using Block = Eigen::Matrix<double, 6, 6>;
  struct Entry {
    int block, row, column;
  };
  struct Factor;

  int block_of(int a, int b);
  void lay_out();
  void fill();

  const DofMap& dofs_;
  std::map<std::pair<int, int>, int> index_;  ///< (higher body, lower body) to block
  std::vector<std::pair<int, int>> bodies_;   ///< of each block
  std::vector<Block> blocks_;                 ///< rows of the higher body, columns of the lower one
  std::vector<Entry> entries_;                ///< of the matrix's values, in their order
  Eigen::SparseMatrix<double> matrix_;
  bool laid_out_ = false, filled_ = false, analysed_ = false, factorised_ = false;
  long factors_ = 0;
  std::unique_ptr<Factor> factor_;
};

}  // namespace kinetix::model
