#pragma once

#include "model/elastic/elasticity.hpp"
#include "model/elastic/element.hpp"
#include "model/state.hpp"

namespace kinetix {

/// A hinge in the rest frames of its two bodies, lengths in cell edges.
struct RestHinge {
  int lower = 0, upper = 0;
  Eigen::Vector3d edge;       ///< unit edge vector
  Eigen::Vector3d lower_arm;  ///< from the lower body's vertex to the hinge point
  Eigen::Vector3d upper_arm;
  Eigen::Vector3d axis;        ///< unit
  Eigen::Vector3d axis_alpha;  ///< its derivative by alpha
  Eigen::Vector3d axis_beta;   ///< and by beta
};

RestHinge rest_hinge(const Hinge& hinge);

/// The two parts of a hinge's energy, in units of k_point edge^2 (Elasticity).
struct HingeEnergy {
  double stretch = 0;  ///< of hinge point and axis
  double turn = 0;
  double total() const { return stretch + turn; }
};

HingeEnergy hinge_energy(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                         const Pose& upper, double edge_mm);

/// @return energy, gradient and Hessian; a is the lower body, b the upper one
Element hinge_element(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                      const Pose& upper, double edge_mm);

/// How the gradient of a hinge's energy changes with its design and stiffness.
struct HingeRates {
  Eigen::Matrix<double, 12, 3> design;  ///< by t, alpha, beta
  Vector12 turn;                        ///< by Stiffness::turn
  Vector12 reach;                       ///< by Stiffness::reach
};

HingeRates hinge_rates(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                       const Pose& upper, double edge_mm);

/// Turn of a hinge (rad, as hinge_turn in model/closure_drive.hpp) as an element: for a driven hinge.
Element turn_element(const RestHinge& hinge, const Pose& lower, const Pose& upper);

}  // namespace kinetix
