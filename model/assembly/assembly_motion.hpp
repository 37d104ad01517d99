#pragma once

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// First-order motion at rest that is nearest to each body turning by its first_turn(), neighbours in opposite
/// directions.
struct FirstMotion {
  std::vector<Twist> twists;  ///< twist of each body, v in cell edges, per rad
  int fastest = -1;           ///< hinge with the largest turn; -1: nothing turns
  double rate = 0;            ///< rate of its turn, rad per rad
  double strain = 0;  ///< norm of the hinges' mismatch over the norm of their turns: the closure error
};

/// Computes the first motion by least squares on the closure equations, with a small weight on the wanted turns. It
/// is therefore valid also if rounded axes make a mechanism strictly rigid. O(hinges) for chains and sheets.
FirstMotion first_motion(const Linkage& linkage);

/// Counts the independent first-order motions at a state, without rigid motions of the whole. They are the singular
/// values of the closure Jacobian below `smallest`. The method is dense, O(bodies^3); the result is empty above 150
/// bodies.
/// @param hinges number of hinges that count, from the start of the list   @param smallest dimensionless, above the
/// rounding of axes and points
std::optional<int> degrees_of_freedom(const Linkage& linkage, const State& state, std::size_t hinges,
                                      double smallest);

/// Returns the first hinge, in the list's order, with which nothing moves any more. @pre no first-order motion with
/// all hinges
int first_rigid_hinge(const Linkage& linkage, double smallest);

/// Motion from rest while one hinge is turned.
struct AssemblyMotion {
  std::vector<State> states;  ///< rest first, mm
  std::vector<double> turns;  ///< turn of the driven hinge in each state, rad
  double gap = 0;             ///< largest joint separation during the motion, cell edges
  double axis_gap = 0;        ///< largest mismatch of hinge axes during the motion, rad
  bool reached = false;       ///< true: the whole turn is reached with all hinges closed within the limit
  int broken = -1;            ///< first hinge that opened beyond the limit; its states are not listed
  double broken_turn = 0;     ///< turn of the driven hinge at that point, rad
};

struct AssemblyMotionOptions {
  double step = 0.035;  ///< step of the driven hinge, rad, > 0: two degrees
  double limit = 2e-3;  ///< tolerance of a hinge in cell edges and rad, > 0: the simulation's limit
  std::function<bool()> stop = {};  ///< returns true to stop; called between steps
};

/// Turns one hinge from rest in steps. Each state is closed from the one before, the first one from the first motion.
/// @param turn rad, in (-pi, pi)
AssemblyMotion follow_turn(const Linkage& linkage, const FirstMotion& first, int hinge, double turn,
                           const AssemblyMotionOptions& options = {});

}  // namespace kinetix::model
