#pragma once

#include <string>
#include <vector>

#include "optim/curve/curve_fit.hpp"

namespace kinetix::optim {

/// Turn that one column would need to follow the goal, and the turn its bounds allow at the given theta.
struct ColumnTurn {
  int column = 0;
  double arc_mm = 0;   ///< where along the goal the column's hinge stands
  double needed = 0;   ///< rad, signed, left > 0
  double allowed = 0;  ///< rad, >= 0: the most its bounds allow to that side
  double excess = 0;   ///< rad, >= 0: how far `needed` lies outside the turns that the bounds allow
};

/// What bounds and cell count let a strip do, against what the goal asks.
struct CurveReach {
  double theta = 0;  ///< rad: the one that gives the straight strip the goal's length, clamped to its bounds
  double shortest_mm = 0;  ///< length of the straight strip at the largest theta
  double longest_mm = 0;   ///< likewise at the smallest theta
  std::vector<ColumnTurn> turns;
  /// Why the goal is out of reach, in words with numbers; empty when nothing speaks against it.
  std::vector<std::string> obstacles;
};

/// Turn that one of so many columns would need to follow the goal: between the chords of one column's length before
/// and after it, where the goal goes that far. rad, left > 0
double needed_turn(const targets::Curve& goal, int column, int columns);

/// Compares it, column by column, with the turn 2 atan(tan(beta) sin(theta)) of its largest tilt.
CurveReach analyse_reach(const CurveFit& fit);

}  // namespace kinetix::optim
