#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/lattice/planar/planar_crease.hpp"

namespace kinetix::model {

/// All exact designs of a planar structure whose hinges lie on their walls: with s = 2 t_A - 1 of each wall and
/// f a wall as it is walked round a cell, the sum of s f vanishes for every cell (kinematics.md section 5). Two
/// conditions a cell make one sparse matrix, its null space holds every s. An orthonormal basis of it is kept as
/// the factors of a sparse QR (SPQR; Davis, ACM TOMS 38, 2011): 100 x 100 hexagons have 10399 basis vectors, too
/// many to write out. Further conditions may be asked for, as that creases stay straight.
class ExactDesigns {
 public:
  explicit ExactDesigns(const PlanarStructure& structure, const std::vector<WallCondition>& further = {});

  /// Free numbers: V - F - 1 + self_stresses(), with V bodies and F cells; less with further conditions.
  int dimension() const { return walls_ - rank_; }
  /// Conditions that follow from others.
  int self_stresses() const { return conditions_ - rank_; }

  /// @param numbers of the basis vectors, dimension() of them   @return s of each wall
  Eigen::VectorXd design(const Eigen::VectorXd& numbers) const;
  /// Those whose design comes nearest to a given s of each wall, in the sum of squares.
  Eigen::VectorXd numbers(const Eigen::VectorXd& s) const;
  /// The smallest change of s, in the sum of squares, that adds given sums of s f, [x, y] of each cell, cell edges,
  /// and then of each further condition what it misses.
  /// As near as may be where cells with self-stresses contradict each other.
  Eigen::VectorXd smallest_change(const Eigen::VectorXd& sums) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;  ///< none without cells
  int walls_ = 0, conditions_ = 0, rank_ = 0;
};

/// The nearest exact design: t of all walls moves, by as little as makes every cell close and keeps every crease
/// straight, in the sum of squares; offsets, alpha and beta stay. Where that takes a t out of its range, (0, 1), it is left there.
PlanarStructure nearest_exact(PlanarStructure structure);

}  // namespace kinetix::model
