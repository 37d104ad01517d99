#pragma once

#include <memory>

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// A scalar function f of an equilibrium, by its derivatives there. What f does not depend on is left out.
struct EquilibriumGradient {
  Eigen::VectorXd state;  ///< by all coordinates: 6 a body, turn (rad) then shift (cell edges); empty: none
  double load =
      0;  ///< by the drive's load, per N for plates and a cord, per N mm for a driven hinge and springs
  double energy = 0;  ///< by the stored energy, per N mm
};

/// The derivatives of f where the structure is in equilibrium again after each change.
struct Sensitivity {
  Eigen::Matrix4Xd
      hinges;        ///< column h: by t (fraction), alpha, beta (rad) and offset (cell edges) of hinge h
  double theta = 0;  ///< by the drive's fold parameter, rad
  double k_point =
      0;  ///< by the fields of Elasticity, N/mm; by hinge: all change by one factor, times k_point
  double k_turn = 0;     ///< N mm/rad, of all hinges
  double reach_mm = 0;   ///< mm, of all hinges
  double k_contact = 0;  ///< N/mm
  double k_spring = 0;   ///< by that of a shape-memory drive, N mm/rad, of all its springs
  /// Column h: by the axial, shear and along of hinge h's own HingeStiffness (N/mm), by its k_turn (N mm/rad)
  /// and reach (mm), by its rock and twist (N mm/rad; 0 of what it leaves to its reach). By play there is none.
  Eigen::Matrix<double, 7, Eigen::Dynamic> stiffness;
};

/// By the adjoint: H lambda = df/dx over the unknowns, df/dp = -lambda . dg/dp, with g the gradient and H the
/// Hessian of the energy; for a driven hinge bordered by its turn, for a cord by its length. One back-substitution whatever
/// the number of parameters, two for a driven hinge and a cord; three between plates in space, where the turn at which the whole is
/// held may meet a moment. Points in contact stay in contact: where one just touches, the derivative is
/// one-sided. Theta of the drive stays: a cord is cos(theta) times as long as in the flat state. What f has of a parameter directly is the caller's to add.
/// @param elasticity that of the system
/// @param state in equilibrium at theta, with the system's multiplier
/// @param tangent linearised at state and factorised without a shift, which succeeded. minimise() may leave
/// the factor of a state before: linearise and factorise again
/// @pre gradient.state has 6 entries a body or none
/// @return NaN for NaN in the gradient; k_contact is 0 where nothing touches, reach_mm in the plane where all
/// hinges stand upright
Sensitivity sensitivity(const ElasticSystem& system, const Elasticity& elasticity, const State& state,
                        double theta, const TangentStiffness& tangent, const EquilibriumGradient& gradient);

/// The derivatives by hinges and by theta alone.
struct DesignSensitivity {
  Eigen::Matrix4Xd
      hinges;        ///< column h: by t (fraction), alpha, beta (rad) and offset (cell edges) of hinge h
  double theta = 0;  ///< by the drive's fold parameter, rad
};

/// The same of many functions of one equilibrium: what each hinge does to all forces is worked out once, which pays from
/// a dozen functions on.
class DesignSensitivities {
 public:
  /// As sensitivity(). All that is passed must outlive it, and stay as it is.
  DesignSensitivities(const ElasticSystem& system, const State& state, double theta,
                      const TangentStiffness& tangent);
  ~DesignSensitivities();

  /// @param by_state derivatives of the function by all coordinates: 6 a body, turn (rad) then shift (cell edges)
  DesignSensitivity of(const Eigen::VectorXd& by_state) const;

  /// Change of the state where all hinges change, to first order: 6 coordinates per body, turn (rad) then shift (cell edges).
  /// Theta of the drive stays. @param changes column h: of t (fraction), alpha, beta (rad) and offset (cell edges) of hinge h
  /// @pre no contacts, and a drive that pulls no cord
  Eigen::VectorXd change(const Eigen::Matrix4Xd& changes) const;

 private:
  struct Table;
  std::unique_ptr<Table> table_;
};

}  // namespace kinetix::model
