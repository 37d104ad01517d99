#pragma once

#include <string>
#include <vector>

#include "optim/curve/curve_fit.hpp"

namespace kinetix::optim {

/// Turn that one column needs to follow the goal, and the turn that its bounds allow at the given theta.
struct ColumnTurn {
  int column = 0;
  double arc_mm = 0;   ///< position of the column's hinge along the goal
  double needed = 0;   ///< rad, signed, left > 0
  double allowed = 0;  ///< rad, >= 0: largest turn to that side within the bounds
  double excess = 0;   ///< rad, >= 0: how far `needed` is outside the turns that the bounds allow
};

/// Shapes that the bounds and the cell count allow, compared with the goal.
struct CurveReach {
  double theta = 0;        ///< rad: gives the straight strip the goal's length, clamped to its bounds
  double shortest_mm = 0;  ///< length of the straight strip at the largest theta
  double longest_mm = 0;   ///< length of the straight strip at the smallest theta
  std::vector<ColumnTurn> turns;
  /// Reasons why the goal is out of reach, with numbers; empty when none was found.
  std::vector<std::string> obstacles;
};

/// Returns the turn that column `column` of `columns` needs to follow the goal, rad, left > 0. It is the turn
/// between the chords of one column's length before and after the column's hinge, cut off at the ends of the
/// goal.
double needed_turn(const targets::Curve& goal, int column, int columns);

/// Compares the needed turn of each column with 2 atan(tan(beta) sin(theta)) of its largest tilt.
CurveReach analyse_reach(const CurveFit& fit);

}  // namespace kinetix::optim
