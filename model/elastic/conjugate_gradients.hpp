#pragma once

#include "model/elastic/tangent_stiffness.hpp"

namespace kinetix::model {

/// A step of a truncated Newton method: about the minimum of g . x + x . H x / 2.
struct TruncatedStep {
  enum class Outcome {
    solved,    ///< its residual is small
    negative,  ///< it ends along a direction of negative curvature, downhill
    slow,      ///< neither, after `most` iterations
  };
  Eigen::VectorXd step;  ///< rad and cell edges, as the unknowns
  Outcome outcome = Outcome::slow;
};

/// Preconditioned conjugate gradients after Steihaug (1983) with the tangent as it is now as H, and its last
/// factor, that of a state nearby or of a shifted tangent, as preconditioner. `solved` is a residual of 2 %
/// of the first in the norm of the preconditioner, or of 30 % after the last iteration.
/// @pre tangent.is_factorised()
TruncatedStep conjugate_gradients(TangentStiffness& tangent, const Eigen::VectorXd& gradient, int most = 20);

}  // namespace kinetix::model
