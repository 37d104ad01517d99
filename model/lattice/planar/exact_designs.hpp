#pragma once

#include <memory>

#include "model/lattice/planar/planar_crease.hpp"

namespace kinetix::model {

/// All exact designs of a planar structure whose hinges are on their walls. With s = 2 t_A - 1 of each wall, and f a
/// wall vector in the direction of the walk around a cell, the sum of s f is zero for every cell (kinematics.md
/// section 5).
/// Two conditions per cell form one sparse matrix, whose null space contains every s. Its orthonormal basis is stored
/// as the factors of a sparse QR (SPQR; Davis, ACM TOMS 38, 2011), because it is too large to write out: 100 x 100
/// hexagons have 10399 basis vectors. Further conditions are optional, for example straight creases.
class ExactDesigns {
 public:
  explicit ExactDesigns(const PlanarStructure& structure, const std::vector<WallCondition>& further = {});

  /// Returns the number of free parameters: V - F - 1 + self_stresses(), with V bodies and F cells; fewer with
  /// further conditions.
  int dimension() const { return walls_ - rank_; }
  /// Returns the number of redundant conditions.
  int self_stresses() const { return conditions_ - rank_; }

  /// @param numbers coordinates in the basis, dimension() of them   @return s of each wall
  Eigen::VectorXd design(const Eigen::VectorXd& numbers) const;
  /// Returns the coordinates of the design nearest to a given s of each wall, in the sum of squares.
  Eigen::VectorXd numbers(const Eigen::VectorXd& s) const;
  /// Returns the smallest change of s, in the sum of squares, that adds given sums of s f. `sums` has [x, y] of each
  /// cell, cell edges, then the missing amount of each further condition. The result is a least-squares one if cells
  /// with self-stresses contradict each other.
  Eigen::VectorXd smallest_change(const Eigen::VectorXd& sums) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;  ///< null without cells
  int walls_ = 0, conditions_ = 0, rank_ = 0;
};

/// Returns the nearest exact design. The t of all walls change by the smallest sum of squares that closes every cell
/// and keeps every crease straight. Offsets, alpha and beta do not change. A t may result outside its range, (0, 1).
PlanarStructure nearest_exact(PlanarStructure structure);

}  // namespace kinetix::model
