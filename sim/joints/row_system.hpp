#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <array>
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
/// whose pattern is analysed only when the parts that the rows join change. Parts are ordered by minimum degree as wholes, six
/// numbers each, since contacts change the pattern often.
class RowSystem {
 public:
  /// @return whether the minimum exists, which negative weights can prevent
  bool factorise(const std::vector<PartMass>& masses, const std::vector<VelocityRow>& rows, double stiffness);

  /// The velocity change that meets the targets, six numbers a part. @pre factorise was called
  Eigen::VectorXd velocities() const { return by_part(factor_.solve(pull_)); }
  /// The velocity change that an impulse on the parts causes while the joints hold. @pre as above
  Eigen::VectorXd response(const Eigen::VectorXd& impulse) const {
    return by_part(factor_.solve(by_place(impulse)));
  }

 private:
  /// A block of the matrix, 6 x 6; of one on the diagonal the lower half.
  struct Block {
    int row = 0, column = 0;        ///< places; row >= column
    std::array<int, 6> start = {};  ///< where each of its columns starts in the values
  };
  /// Rows of the same two parts, one after another: those of a joint.
  struct Joint {
    int a = -1, b = -1;   ///< parts; -1 = fixed to the ground
    std::size_t end = 0;  ///< behind its last row
    int mixed = -1;       ///< block of both parts; -1 where one is fixed
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
  std::vector<int> place_;     ///< of each part in the matrix: for little fill
  std::vector<Block> blocks_;  ///< those on the diagonal first, by part
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
  Eigen::VectorXd pull_;  ///< by place
};

}  // namespace kinetix::sim
