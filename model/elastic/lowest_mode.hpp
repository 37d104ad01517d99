#pragma once

#include "model/elastic/tangent_stiffness.hpp"

namespace kinetix::model {

/// Softest direction of a structure. Eigenvalues in k_point edge^2.
struct LowestMode {
  double value = 0;  ///< smallest eigenvalue of the tangent; negative if an equilibrium is not a minimum
  double next = 0;   ///< second smallest eigenvalue; NaN if there is none
  Eigen::VectorXd direction;  ///< by the unknowns (rad, cell edges); largest entry has magnitude 1
  bool converged = false;
};

/// Computes the lowest mode by Lanczos iteration on the shifted inverse (dense below 60 unknowns).
/// Deterministic.
LowestMode lowest_mode(TangentStiffness& tangent);

}  // namespace kinetix::model
