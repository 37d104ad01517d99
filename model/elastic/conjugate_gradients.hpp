#pragma once

#include "model/elastic/tangent_stiffness.hpp"

namespace kinetix::model {

/// Step of a truncated Newton method: an approximate minimum of g . x + x . H x / 2.
struct TruncatedStep {
  enum class Outcome {
    solved,    ///< its residual is small
    negative,  ///< it ends along a direction of negative curvature, downhill
    slow,      ///< neither, after `most` iterations
  };
  Eigen::VectorXd step;  ///< rad and cell edges, as the unknowns
  Outcome outcome = Outcome::slow;
};

/// Computes a step by preconditioned conjugate gradients after Steihaug (1983). H is the present tangent. Its
/// last factor, that of a nearby state or of a shifted tangent, is the preconditioner. `solved` means a
/// residual of 2 % of the first one in the norm of the preconditioner, or of 30 % after the last iteration.
/// @pre tangent.is_factorised()
TruncatedStep conjugate_gradients(TangentStiffness& tangent, const Eigen::VectorXd& gradient, int most = 20);

}  // namespace kinetix::model
