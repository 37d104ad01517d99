#pragma once

#include <cstdint>

#include "optim/curve/curve_fit.hpp"

namespace kinetix::optim {

/// Column half turns psi_c (rad) and theta that lay the chords of a strip end to end along a curve.
struct ChordLayout {
  std::vector<double> psi;  ///< half turn of each column, rad, positive turns left
  std::vector<double> arc;  ///< arc length of each of the columns + 1 chord ends on the goal, mm
  double carried_edge_mm =
      0;  ///< the cell's carried edge L cos(theta) that gives the chords their length, mm
};

/// Chord c leaves direction tau_c by psi_c, has length L cos(theta) cos(psi_c), and
/// tau_{c+1} = tau_c + 2 psi_c. One degree of freedom is left, a zigzag (psi_0, -psi_0, ...) that no chord
/// direction feels.
/// @param zigzag added to the smoothest layout (least sum of psi^2), rad
ChordLayout lay_chords(const targets::Curve& goal, int columns, double zigzag);

/// Start k of a search: 0 is the smoothest layout, 1 turns all columns alike where the bounds cut that layout
/// (the best that tight bounds may leave), the others are zigzags of growing size, and random ones from
/// `zigzag_starts` on. Depends on (seed, k) alone. @return x of CurveFit, in its units
Eigen::VectorXd curve_start(const CurveFit& fit, int k, std::uint64_t seed);

inline constexpr int zigzag_starts = 16;  ///< starts by rule, zigzags of up to 0.35 rad; then random ones

}  // namespace kinetix::optim
