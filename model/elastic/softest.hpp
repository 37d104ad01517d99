#pragma once

#include "model/elastic/tangent.hpp"

namespace kinetix {

/// The direction in which a structure gives way most easily.
struct Softest {
  double value = 0;            ///< smallest eigenvalue of the tangent: negative where a balance is no minimum
  double next = 0;             ///< the one after it; NaN where there is none
  Eigen::VectorXd direction;   ///< its eigenvector, over the unknowns, largest entry 1 in magnitude
  bool converged = false;
};

/// By Lanczos iteration on the shifted inverse (dense below 60 unknowns). Same result on every call.
Softest softest(Tangent& tangent);

}  // namespace kinetix
