#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// The first-order motion at rest that is nearest to every body turning by its first_turn(), neighbours against each other.
struct FirstMotion {
  std::vector<Twist> twists;  ///< of each body, v in cell edges, per rad
  int fastest = -1;           ///< the hinge that turns most by it; -1: nothing turns
  double rate = 0;            ///< of its turn, rad per rad
  double strain = 0;  ///< rms mismatch of the hinges over the rms turn of the hinges: what it leaves open
};

/// Least squares on the closure equations with a small pull towards what is wanted: so it holds also where rounded axes make a
/// mechanism rigid to the letter. O(hinges) for chains and sheets.
FirstMotion first_motion(const Linkage& linkage);

/// How many independent first-order motions there are at a state, those of the whole as a rigid body aside: singular values of the closure Jacobian
/// below `smallest`. Dense, O(bodies^3): nothing above 150 bodies.
/// @param hinges of the list's first ones that count   @param smallest dimensionless, above the rounding of axes and points
std::optional<int> degrees_of_freedom(const Linkage& linkage, const State& state, std::size_t hinges,
                                      double smallest);

/// A structure without any first-order motion: the first hinge, in the list's order, with which nothing moves any more.
int first_rigid_hinge(const Linkage& linkage, double smallest);

/// The way from rest while one hinge is turned.
struct AssemblyMotion {
  std::vector<State> states;  ///< rest first, mm
  std::vector<double> turns;  ///< of the driven hinge, rad
  double gap = 0;             ///< largest mismatch of hinge points met, cell edges
  double axis_gap = 0;        ///< and of hinge axes, rad
  bool reached = false;       ///< the whole turn, all hinges closed within the limit
  int broken = -1;            ///< the hinge that opened first beyond the limit; its states are not listed
  double broken_turn = 0;     ///< at which it did, rad
};

struct AssemblyMotionOptions {
  double step = 0.035;  ///< rad of the driven hinge, > 0: two degrees
  double limit =
      2e-3;  ///< cell edges and rad, by which a hinge may be open, > 0: what the physics run allows
  std::function<bool()> stop = {};  ///< asked between steps
};

/// Each state is closed from the one before, the first from the first motion. @param turn rad, in (-pi, pi)
AssemblyMotion follow_turn(const Linkage& linkage, const FirstMotion& first, int hinge, double turn,
                           const AssemblyMotionOptions& options = {});

}  // namespace kinetix::model
