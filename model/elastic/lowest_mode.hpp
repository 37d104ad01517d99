#pragma once

#include "model/elastic/tangent_stiffness.hpp"

namespace kinetix::model {

/// The direction in which a structure gives way most easily. Eigenvalues in k_point edge^2.
struct LowestMode {
  double value = 0;  ///< smallest eigenvalue of the tangent: negative where an equilibrium is no minimum
  double next = 0;   ///< the one after it; NaN where there is none
  Eigen::VectorXd direction;  ///< its eigenvector, by the unknowns (rad, cell edges), largest entry
                              ///< 1 in magnitude
  bool converged = false;
};

/// By Lanczos iteration on the shifted inverse (dense below 60 unknowns). Same result on every call.
LowestMode lowest_mode(TangentStiffness& tangent);

}  // namespace kinetix::model
