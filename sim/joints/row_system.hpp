#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <map>
#include <utility>
#include <vector>

namespace kinetix::sim {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What resists a change of a part's velocity.
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
/// A velocity change v minimises v' M v + stiffness * |J v - target|^2, with M the masses: Gauss's
/// principle with joints so stiff that the difference cannot be seen, and well-posed for equations that
/// repeat each other, which closed loops of an exactly mobile sheet have. Cost: one sparse factorisation,
/// whose pattern is analysed only when the parts that the rows join change.
class RowSystem {
 public:
  /// @return whether the minimum exists, which negative weights can prevent
  bool factorise(const std::vector<PartMass>& masses, const std::vector<VelocityRow>& rows, double stiffness);

  /// The velocity change that meets the targets, six numbers a part. @pre factorise was called
  Eigen::VectorXd velocities() const { return factor_.solve(pull_); }
  /// The velocity change that an impulse on the parts causes while the joints hold. @pre as above
  Eigen::VectorXd response(const Eigen::VectorXd& impulse) const { return factor_.solve(impulse); }

 private:
  using Pair = std::pair<int, int>;  ///< row block, column block; row >= column

  bool has_pattern_of(std::size_t parts, const std::vector<VelocityRow>& rows) const;
  void analyse(std::size_t parts, const std::vector<VelocityRow>& rows);
  void add_block(Pair pair, const Matrix6& block);

  std::size_t parts_ = 0;
  std::vector<Pair> joined_;
  std::map<Pair, std::array<int, 6>> starts_;  ///< where each column of a block starts in the values
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
  Eigen::VectorXd pull_;
};

}  // namespace kinetix::sim
