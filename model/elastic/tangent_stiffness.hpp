#pragma once

#include <Eigen/SparseCore>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "model/elastic/dof_map.hpp"
#include "model/hinge/element.hpp"

namespace kinetix::model {

/// Sparse symmetric matrix of second derivatives by the unknowns, with its Cholesky factor. It consists of 6
/// x 6 blocks of pairs of bodies, in units of k_point edge^2. The symbolic factorisation is reused until a
/// new pair is added.
class TangentStiffness {
 public:
  explicit TangentStiffness(const DofMap& dofs);
  ~TangentStiffness();

  void clear();
  /// Adds the Hessian of an element. @param a, b the element's bodies, different
  void add(int a, int b, const Element& element);
  /// Adds second derivatives by the coordinates of several bodies, six per body.
  /// @param bodies ascending, different
  void add(const std::vector<int>& bodies, const Eigen::MatrixXd& hessian);

  /// Factorises the matrix plus `shift` times the identity. @return whether that is positive definite
  bool factorise(double shift);
  /// Returns whether the last factorise() succeeded: of this matrix, or of one before clear().
  bool is_factorised() const { return factorised_; }
  /// Returns the number of calls of factorise(). If it has not changed, the factor has not changed either.
  long factors() const { return factors_; }
  /// @pre is_factorised()
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;
  Eigen::VectorXd multiply(const Eigen::VectorXd& x);
  /// Multiplies by the matrix over all coordinates, including held ones.
  Eigen::VectorXd multiply_all(const Eigen::VectorXd& all) const;

  int size() const { return dofs_.count; }
  /// Lower triangle of the matrix at the last factorise().
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
  std::vector<Entry> entries_;  ///< positions of the matrix's values in the blocks, in their order
  Eigen::SparseMatrix<double> matrix_;
  bool laid_out_ = false, filled_ = false, analysed_ = false, factorised_ = false;
  long factors_ = 0;
  std::unique_ptr<Factor> factor_;
};

}  // namespace kinetix::model
