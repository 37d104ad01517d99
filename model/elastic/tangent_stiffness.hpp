#pragma once

#include <Eigen/SparseCore>
#include <map>
#include <memory>
#include <utility>

#include "model/hinge/element.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Unknowns of an equilibrium among the six coordinates of each body (rad and cell edges, ordered as in
/// model/closure/closure.hpp).
struct DofMap {
  std::vector<std::array<int, 6>> unknown;  ///< of each body; -1 if the coordinate is held or driven
  int count = 0;

  Eigen::Index coordinates() const { return 6 * static_cast<Eigen::Index>(unknown.size()); }
  /// Returns the entries of a vector over all coordinates that are unknowns.
  Eigen::VectorXd restrict(const Eigen::VectorXd& all) const;
  /// Returns the vector over all coordinates with the given unknowns, zero elsewhere.
  Eigen::VectorXd extend(const Eigen::VectorXd& unknowns) const;
};

/// Numbers the unknowns. Planar bodies have one turn and two shifts. Plates prescribe one coordinate of the
/// bodies they grip. The middle body of each gripped row is keyed to z = 0, as in the simulation. The
/// remaining rigid motion is held at the first of these two, without reaction force. For other drives, or
/// none, it is held at LinkageDrive::held_body().
DofMap make_dof_map(const Linkage& structure, const LinkageDrive& drive, bool planar);

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
