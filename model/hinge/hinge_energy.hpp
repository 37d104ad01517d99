#pragma once

#include "model/hinge/elasticity.hpp"
#include "model/hinge/hinge_turn.hpp"

namespace kinetix::model {

/// The two parts of a hinge's energy, in units of k_point edge^2 (Elasticity).
struct HingeEnergy {
  double stretch = 0;  ///< of the mismatches of hinge point and axis
  double turn = 0;
  double total() const { return stretch + turn; }
};

/// Returns the energy of a hinge in units of k_point edge^2.
HingeEnergy hinge_energy(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                         const Pose& upper, double edge_mm);

/// Returns energy, gradient and Hessian in units of k_point edge^2. Body a is the lower one, b the upper one.
Element hinge_element(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                      const Pose& upper, double edge_mm);

/// Returns the gradient without the Hessian, in a third of the time. Unit k_point edge^2.
Vector12 hinge_gradient(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                        const Pose& upper, double edge_mm);

/// Derivatives of a quantity of a hinge by its design and stiffness.
struct HingeGradient {
  DesignGradient design = DesignGradient::Zero();
  double turn = 0;                 ///< by Stiffness::turn, per k_point edge^2
  double reach = 0;                ///< by Stiffness::reach, per cell edge
  PointRatios ratios = {0, 0, 0};  ///< by Stiffness::ratios
  double rock = 0, twist = 0;      ///< by Stiffness::tilt, per k_point edge^2; 0 if tilt is empty
};

struct HingeGradients {
  HingeGradient energy;  ///< of the energy, k_point edge^2
  HingeGradient along;   ///< of its derivative along given twists
};

/// Returns the derivatives of the hinge's energy by design and stiffness.
/// @param along twists of the two bodies (rad, cell edges), ordered as in Element
HingeGradients hinge_gradients(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                               const Pose& upper, double edge_mm, const Vector12& along);

}  // namespace kinetix::model
