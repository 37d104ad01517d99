#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

/// Derivatives of a scalar function f of an equilibrium. Fields that f does not depend on may stay unset.
struct EquilibriumGradient {
  Eigen::VectorXd state;  ///< by all coordinates: 6 per body, turn (rad) then shift (cell edges); empty: 0
  /// Derivative by the drive's load: per N for plates and a tendon, per N mm for a driven hinge and springs.
  double load = 0;
  double energy = 0;  ///< by the stored energy, per N mm
};

/// Derivatives of f along equilibria: after each change the structure is in equilibrium again.
struct Sensitivity {
  /// Column h: by t (fraction), alpha, beta (rad) and offset (cell edges) of hinge h.
  Eigen::Matrix4Xd hinges;
  double theta = 0;  ///< by the drive's fold parameter, rad
  /// Derivatives by the fields of Elasticity, N/mm. With per-hinge values, all change by one factor, times k_point.
  double k_point = 0;
  double k_turn = 0;     ///< N mm/rad, of all hinges
  double reach_mm = 0;   ///< mm, of all hinges
  double k_contact = 0;  ///< N/mm
  double k_spring = 0;   ///< by the stiffness of a shape-memory drive, N mm/rad, of all its springs.
  /// Column h, by the stiffness of hinge h: axial, shear and along of its HingeStiffness (N/mm), k_turn
  /// (N mm/rad), reach (mm), rock and twist (N mm/rad; 0 if the reach gives them). There is no derivative by
  /// clearance.
  Eigen::Matrix<double, 7, Eigen::Dynamic> stiffness;
};

/// Computes derivatives of f by the adjoint method. With g the gradient and H the Hessian of the energy, H
/// lambda = df/dx over the unknowns, and df/dp = -lambda . dg/dp. A driven hinge borders H by its turn, a
/// tendon by its length. The cost is one back-substitution for any number of parameters, and two for a driven
/// hinge or a tendon. Between plates in space it is three, because there may be a moment about the axis at
/// which the whole is held.
///
/// Points in contact are assumed to stay in contact. If a point just touches, the derivative is one-sided.
/// Theta of the drive is kept: a tendon is cos(theta) times as long as in the flat state. The caller adds the
/// explicit dependence of f on a parameter.
///
/// @param elasticity that of the system
/// @param state in equilibrium at theta, with the system's multiplier
/// @param tangent linearised at state and successfully factorised without a shift. minimise() may leave the
///   factor of an earlier state: linearise and factorise again
/// @pre gradient.state has 6 entries per body or none
/// @return NaN for NaN in the gradient. k_contact is 0 without contact; reach_mm is 0 in the plane if all
///   hinges are vertical
Sensitivity sensitivity(const ElasticSystem& system, const Elasticity& elasticity, const State& state,
                        double theta, const TangentStiffness& tangent, const EquilibriumGradient& gradient);

/// Derivatives by the hinges and by theta only.
struct DesignSensitivity {
  /// Column h: by t (fraction), alpha, beta (rad) and offset (cell edges) of hinge h.
  Eigen::Matrix4Xd hinges;
  double theta = 0;  ///< by the drive's fold parameter, rad
};

/// Sensitivities of many functions of one equilibrium. The effect of each hinge on all forces is computed
/// once, which is faster than sensitivity() from a dozen functions on.
class DesignSensitivities {
 public:
  /// Takes the parameters of sensitivity(). All of them must outlive this object unchanged.
  DesignSensitivities(const ElasticSystem& system, const State& state, double theta,
                      const TangentStiffness& tangent);
  ~DesignSensitivities();

  /// Returns the derivatives of one function.
  /// @param by_state derivatives of the function by all coordinates: 6 per body, turn (rad) then shift (cell
  ///   edges)
  DesignSensitivity of(const Eigen::VectorXd& by_state) const;

  /// Returns the first-order change of the state if all hinges change: 6 coordinates per body, turn (rad)
  /// then shift (cell edges). Theta of the drive is kept.
  /// @param changes column h: of t (fraction), alpha, beta (rad) and offset (cell edges) of hinge h
  /// @pre no contacts, and a drive other than a tendon
  Eigen::VectorXd change(const Eigen::Matrix4Xd& changes) const;

 private:
  struct Table;
  std::unique_ptr<Table> table_;
};

}  // namespace kinetix::model
