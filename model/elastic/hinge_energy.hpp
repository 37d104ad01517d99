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

/// How a hinge's energy, and its gradient as an element, change with its design and stiffness.
struct HingeRates {
  Eigen::Matrix<double, 12, 3> design;  ///< of the gradient, by t, alpha, beta
  Vector12 turn;                        ///< by Stiffness::turn
  Vector12 reach;                       ///< by Stiffness::reach
  Eigen::Vector3d energy_design;        ///< of the energy, by t, alpha, beta
  double energy_turn = 0;               ///< by Stiffness::turn
  double energy_reach = 0;              ///< by Stiffness::reach
};

HingeRates hinge_rates(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                       const Pose& upper, double edge_mm);

/// Turn of a hinge (rad, as hinge_turn in model/closure_drive.hpp) as an element: for a driven hinge.
Element turn_element(const RestHinge& hinge, const Pose& lower, const Pose& upper);

/// How that turn and its gradient change with the hinge's t, alpha and beta (t: not at all).
struct TurnRates {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rad by each
  Eigen::Matrix<double, 12, 3> gradient = Eigen::Matrix<double, 12, 3>::Zero();
};

TurnRates turn_rates(const RestHinge& hinge, const Pose& lower, const Pose& upper);

}  // namespace kinetix
