#pragma once

#include <cstdint>

#include "optim/curve/curve_fit.hpp"

namespace kinetix::optim {

/// Half turns psi_c of the columns (rad) that lay the chords of a strip end to end along a curve.
struct ChordLayout {
  std::vector<double> psi;     ///< half turn of each column, rad, positive turns left
  std::vector<double> arc;     ///< arc length of each of the columns + 1 chord ends on the goal, mm
  double carried_edge_mm = 0;  ///< edge L cos(theta) of a folded cell that gives the chords their length
};

/// Lays the chords of a strip along the goal. Chord c leaves direction tau_c by psi_c, has length L
/// cos(theta) cos(psi_c), and tau_{c+1} = tau_c + 2 psi_c. One degree of freedom remains: a zigzag (psi_0,
/// -psi_0, ...) that changes no chord direction.
/// @param zigzag added to the smoothest layout (least sum of psi^2), rad
ChordLayout lay_chords(const targets::Curve& goal, int columns, double zigzag);

/// Returns start k of a search, as x of CurveFit in its units. Start 0 is the smoothest layout. If the bounds
/// cut that layout, start 1 turns all columns by the same amount, often the best under tight bounds. The
/// other starts are zigzags of growing size, random from `zigzag_starts` on. The result depends on (seed, k)
/// only.
Eigen::VectorXd curve_start(const CurveFit& fit, int k, std::uint64_t seed);

inline constexpr int zigzag_starts = 16;  ///< starts by rule, with zigzags of up to 0.35 rad; the others are
                                          ///< random

}  // namespace kinetix::optim
