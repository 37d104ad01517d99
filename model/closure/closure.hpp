#pragma once

#include <Eigen/SparseCore>
#include <variant>

#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Returns the residual of the closure conditions in any state, in six coordinates per body. It is
/// independent of the exact families.
/// Each hinge has six rows. Three are the mismatch of the hinge point, lower body minus upper body, in cell
/// edges. Three are the mismatch of the unit hinge axis. A small mismatch of the axis is in the plane normal
/// to it, so that five of the six rows count.
/// @pre state.size() == structure.bodies.size()
Eigen::VectorXd closure_residual(const Linkage& structure, const State& state);

/// Returns the derivative of closure_residual with respect to the bodies' twists, as entries or as a matrix.
/// Columns 6b..6b+2 are a turn omega of body b about its position (dR = [omega]x R, rad). Columns 6b+3..6b+5
/// are a shift of its position in cell edges.
std::vector<Eigen::Triplet<double>> closure_entries(const Linkage& structure, const State& state);
Eigen::SparseMatrix<double> closure_jacobian(const Linkage& structure, const State& state);

/// Returns the state (mm) after every body turns by exp(omega) and shifts in a straight line. `twists` has
/// the order of the columns above. model/closure/closure.hpp has the retract along screws.
State retract_straight(const Linkage& structure, const State& state, const Eigen::VectorXd& twists);

/// Returns the state after every body has moved for one unit along the screw motion of its twist. Rows 6b..
/// of `twists` have the turn, rad, and the shift of the position, cell edges, as in
/// model/closure/closure.hpp. Positions move along arcs. To first order this equals retract_straight() of
/// model/closure/closure.hpp, but long chains of bodies that turn together stay closed far better.
State retract(const Linkage& structure, const State& state, const Eigen::VectorXd& twists);

/// A drive that turns the upper body of a hinge about the hinge axis, relative to the lower body. On the
/// y-wall of body (0, 0), the fold parameter theta is the angle -2 theta.
struct HingeTurn {
  int hinge = 0;
  double angle = 0;  ///< rad, (-pi, pi)

  bool operator==(const HingeTurn&) const = default;
};

/// A drive that prescribes the motion of one body since `from` along one direction:
/// direction.omega . (turn since from, rad) + direction.v . (shift since from, in cell edges) = amount.
struct BodyPush {
  int body = 0;
  Pose from;
  Twist direction;    ///< v in cell edges; not zero
  double amount = 0;  ///< rad and cell edges; the turn that results must stay below pi
};

/// Scalar condition that drives a structure.
using ClosureDrive = std::variant<HingeTurn, BodyPush>;

/// @throws InvalidInput for a body or hinge that does not exist, or numbers out of range
void validate(const ClosureDrive& drive, const Linkage& structure);

/// Returns the turn of a hinge in a state, rad, (-pi, pi].
double hinge_turn(const Linkage& structure, const State& state, int hinge);
/// Returns the largest difference of a hinge's turn between two states, rad. The differences do not add up
/// along chains.
double turn_distance(const Linkage& structure, const State& a, const State& b);

/// Returns the deviation of the state from the drive's target, rad or cell edges.
double drive_residual(const ClosureDrive& drive, const Linkage& structure, const State& state);

/// Appends the derivative of drive_residual by the bodies' twists (rad, cell edges; columns as in
/// closure.hpp) as row `row`.
void append_drive_gradient(const ClosureDrive& drive, const Linkage& structure, const State& state, int row,
                           std::vector<Eigen::Triplet<double>>& entries);

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
