#pragma once

#include <string>
#include <vector>

#include "model/closure/closure_drive.hpp"

namespace kinetix::model {

struct ClosureOptions {
  int max_iterations = 200;  ///< >= 0
  double tolerance = 1e-12;  ///< > 0; largest entry of the residual of a closed state, rad or cell edges
  double step_tolerance =
      1e-11;  ///< > 0; a smaller step (rad, cell edges) means that no better state is near

  /// @throws InvalidInput
  void validate() const;
};

/// What the solver reached. `converged` says that the search came to an end; whether the hinges then fit is
/// `closed`. A structure that cannot follow its drive converges with a misfit.
struct Closure {
  State state;
  bool converged = false;
  bool closed = false;  ///< every entry of the closure residual and every drive within the tolerance
  double residual = 0;  ///< the largest entry of closure_residual and of the drives' residuals, rad or
                        ///< cell edges
  int iterations = 0;
  std::string why;  ///< one sentence
};

/// State (mm) near `start` that closes all hinges in the least-squares sense under drives, body 0 held at its
/// pose in `start`: Levenberg-Marquardt on the equations of closure.hpp with sparse factorisation. It knows
/// nothing of the exact families. Drives weigh a thousand times a hinge: where hinges cannot close they give
/// way and the drive does not. Numbers in `start` that are not finite give converged = false.
/// @throws InvalidInput for options or a drive out of range, or a start with another number of bodies
Closure solve_closure(const Linkage& structure, const State& start, const std::vector<ClosureDrive>& drives,
                      const ClosureOptions& options = {});

}  // namespace kinetix::model
