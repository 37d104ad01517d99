#pragma once

#include <string>
#include <vector>

#include "model/closure/closure_drive.hpp"

namespace kinetix::model {

struct ClosureOptions {
  int max_iterations = 200;       ///< >= 0
  double tolerance = 1e-12;       ///< > 0; largest entry of the residual of a closed state, rad or cell edges
  double step_tolerance = 1e-11;  ///< > 0; a smaller step ends the search, rad or cell edges

  /// @throws InvalidInput
  void validate() const;
};

/// Result of the solver. `converged` means that the search ended, and `closed` that the hinges then fit. A
/// structure that cannot follow its drive converges with a misfit.
struct Closure {
  State state;
  bool converged = false;
  bool closed = false;  ///< every entry of the closure residual and every drive within the tolerance
  double residual = 0;  ///< largest entry of closure_residual and of the drives' residuals, rad or cell edges
  int iterations = 0;
  std::string why;  ///< one sentence that explains the result
};

/// Returns a state (mm) near `start` that closes all hinges in the least-squares sense under drives. Body 0
/// keeps its pose of `start`. The method is Levenberg-Marquardt on the equations of closure.hpp with sparse
/// factorisation, independent of the exact families. A drive weighs a thousand times a hinge: hinges that
/// cannot close give way and the drive does not. If a number in `start` is not finite, the result has
/// converged = false.
/// @throws InvalidInput for options or a drive out of range, or a start with another number of bodies
Closure solve_closure(const Linkage& structure, const State& start, const std::vector<ClosureDrive>& drives,
                      const ClosureOptions& options = {});

}  // namespace kinetix::model
