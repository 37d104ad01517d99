#pragma once

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

struct NewtonOptions {
  int max_iterations = 60;  ///< >= 1
  /// Largest entry of the gradient, k_point edge^2, times (1 + size of the structure in cells).
  double force_tolerance = 1e-13;
  double step_tolerance = 1e-11;  ///< rad, cell edges: a shorter step (ElasticSystem::length) ends the search
  /// A short step ends the search only if it lowers the energy by at most this fraction, or is below 1e-8.
  double energy_tolerance = INFINITY;
  double drive_tolerance = 1e-12;  ///< of a driven hinge's turn, rad
  double longest_step = 0.25;      ///< rad, cell edges
  /// Rad, cell edges: a search that met negative curvature and moved further in total ends without
  /// convergence.
  double most_moved = INFINITY;
  /// A search whose first tangent is not positive definite ends without convergence.
  bool starts_convex = false;
};

struct NewtonResult {
  bool converged = false;
  bool stable = false;          ///< whether the tangent of the last state is positive definite
  bool was_indefinite = false;  ///< whether the tangent of an intermediate state was not
  double force = 0;             ///< largest entry of the gradient by the unknowns, k_point edge^2
  double moved = 0;    ///< sum of the steps' lengths, without those by an old factor, rad or cell edges
  int iterations = 0;  ///< each with a new tangent
};

/// Minimises the energy of a system at fold parameter theta, rad, starting from `state`. In `state`, the
/// gripped bodies must be in place. Method: Newton's with the exact Hessian. A step is shortened if it does
/// not lower the energy. The Hessian is shifted if it is not positive definite.
///
/// A factor is reused as long as each step is much shorter than the one before. In large systems with a
/// coarse step_tolerance it is also the preconditioner of conjugate gradients for later steps.
///
/// An equilibrium that is not a minimum, for example a symmetric one, is also a result, with stable = false.
/// Afterwards `tangent` is that of the last state. If stable, it is factorised there, or at a state at most
/// 1e-5, or step_tolerance, before.
///
/// @param factorised whether `tangent` has the factor of a nearby state, which is then used first
NewtonResult minimise(ElasticSystem& system, double theta, const NewtonOptions& options, State& state,
                      TangentStiffness& tangent, bool factorised = false);

/// Minimises the energy and prepares `tangent` for sensitivity(): linearised and factorised at the state
/// found.
/// @return false if no stable equilibrium is found
bool settle(ElasticSystem& system, double theta, State& state, TangentStiffness& tangent);

}  // namespace kinetix::model
