#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <array>
#include <utility>
#include <vector>

namespace kinetix::sim {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Resistance of a part to a change of its velocity.
struct PartMass {
  double mass = 1;                                        ///< in any unit of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();  ///< about the centre of mass, in the world's axes,
                                                          ///< in units of mass length^2
};

/// One equation first . v_a + second . v_b = target on the velocities (linear in length/s, angular in rad/s)
/// of two parts.
struct VelocityRow {
  int a = -1, b = -1;  ///< parts; -1 = fixed to the ground
  Vector6 first, second;
  double target = 0;  ///< length/s or rad/s
  double weight = 1;  ///< over the stiffness of the system
};

/// All joint equations of a step, factorised at once by sparse Cholesky.
///
/// A velocity change v minimises v' M v + stiffness * |J v - target|^2, with M the masses. It is Gauss's
/// principle with joints so stiff that the difference cannot be seen. It is well-posed for equations that
/// repeat each other, which closed loops of an exactly mobile sheet have. Cost: one sparse factorisation,
/// whose pattern is analysed only when the parts that the rows join change. Parts are ordered by minimum
/// degree as wholes, six numbers each, since contacts change the pattern often.
class RowSystem {
 public:
  /// @return whether the minimum exists, which negative weights can prevent
  bool factorise(const std::vector<PartMass>& masses, const std::vector<VelocityRow>& rows, double stiffness);

  /// Returns the velocity change that meets the targets, six numbers per part. @pre factorise was called
  Eigen::VectorXd velocities() const { return by_part(factor_.solve(pull_)); }
  /// Returns the velocity change caused by an impulse on the parts while the joints hold.
  /// @pre factorise was called
  Eigen::VectorXd response(const Eigen::VectorXd& impulse) const {
    return by_part(factor_.solve(by_place(impulse)));
  }

 private:
  /// Block of the matrix, 6 x 6; on the diagonal only its lower half.
  struct Block {
    int row = 0, column = 0;        ///< places; row >= column
    std::array<int, 6> start = {};  ///< index of each of its columns' first value
  };
  /// Consecutive rows of the same two parts: those of a joint.
  struct Joint {
    int a = -1, b = -1;   ///< parts; -1 = fixed to the ground
    std::size_t end = 0;  ///< index after its last row
    int mixed = -1;       ///< block of both parts; -1 if one is fixed
  };

  bool has_pattern_of(std::size_t parts, const std::vector<VelocityRow>& rows) const;
  void analyse(std::size_t parts, const std::vector<VelocityRow>& rows);
  void order(const std::vector<std::pair<int, int>>& joined);
  void lay_out();
  Eigen::VectorXd by_part(const Eigen::VectorXd& by_place) const;
  Eigen::VectorXd by_place(const Eigen::VectorXd& by_part) const;
  void add(const Block& block, const Matrix6& values);
  void add(const Joint& joint, std::size_t first, const std::vector<VelocityRow>& rows, double stiffness);

  std::size_t parts_ = 0;
  std::vector<Joint> joints_;
  std::vector<int> place_;     ///< place of each part in the matrix, chosen for little fill
  std::vector<Block> blocks_;  ///< those on the diagonal first, by part
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
  Eigen::VectorXd pull_;  ///< by place
};

}  // namespace kinetix::sim
