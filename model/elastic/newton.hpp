#pragma once

#include <cmath>
#include <string>

#include "model/elastic/elastic_system.hpp"

namespace kinetix::model {

struct NewtonOptions {
  int max_iterations = 60;  ///< >= 1
  double force_tolerance =
      1e-13;  ///< largest entry of the gradient, k_point edge^2, times (1 + size of the structure in cells)
  double step_tolerance = 1e-11;  ///< rad, cell edges: a shorter step (ElasticSystem::length) ends the search
  double energy_tolerance = INFINITY;  ///< and lowers the energy by at most this part of it, or is below 1e-8
  double drive_tolerance = 1e-12;      ///< of a driven hinge's turn, rad
  double longest_step = 0.25;          ///< rad, cell edges
  double most_moved = INFINITY;  ///< rad, cell edges: a search that met negative curvature and went further
                                 ///< in all ends, not converged
  bool starts_convex = false;    ///< and so does one whose first tangent is not positive definite
};

struct NewtonResult {
  bool converged = false;
  bool stable = false;        ///< the tangent of the last state is positive definite
  bool met_negative = false;  ///< that of a state on the way was not
  double force = 0;           ///< largest entry of the gradient by the unknowns, k_point edge^2
  double moved = 0;           ///< lengths of all steps, those by an old factor left out, rad or cell edges
  int iterations = 0;         ///< each with a tangent of its own
};

/// Minimises the energy of a system at fold parameter theta, rad, from `state`, in which what the drive grips
/// must be in place: Newton's method with the exact Hessian, its step shortened where it does not lower the
/// energy, and the Hessian shifted where it is not positive definite. A factor is used for further steps as
/// long as each is much shorter than the one before; in large systems of which little accuracy is asked
/// (step_tolerance) also as the preconditioner of conjugate gradients for the steps after. A state of
/// equilibrium that is no minimum (a symmetric one, say) is a result too, with stable = false. Afterwards
/// `tangent` is that of the last state, factorised if stable (there or a step of at most 1e-5, or
/// step_tolerance, before). @param factorised `tangent` is, in a state nearby: its factor is used first
NewtonResult minimise(ElasticSystem& system, double theta, const NewtonOptions& options, State& state,
                      TangentStiffness& tangent, bool factorised = false);

/// Likewise, and makes `tangent` ready for sensitivity(): linearised at the state found and factorised there.
/// @return false where no stable equilibrium is found
bool settle(ElasticSystem& system, double theta, State& state, TangentStiffness& tangent);

}  // namespace kinetix::model
