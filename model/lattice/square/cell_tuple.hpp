#pragma once

#include <array>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// The paper's description of one cell (Eq. 2, 5, 7): four walls counter-clockwise from the bottom-left corner. Edge
/// vectors follow that walk, so that the top and the left wall are opposite to the lattice direction.
struct CellTuple {
  std::array<double, 4> P = {0.5, 0.5, 0.5, 0.5};  ///< hinge positions, fractions of the wall, (0, 1)
  std::array<double, 4> A_in = {pi / 2, pi / 2, pi / 2, pi / 2};  ///< in-plane angles, rad, (0, pi)
  std::array<double, 4> A_out = {0, 0, 0, 0};                     ///< out-of-plane angles, rad, (-pi/2, pi/2)

  /// Returns the hinge parameters of wall k = 0..3 (bottom, right, top, left) in lattice direction.
  HingeParameters wall(int k) const;
};

/// Treatment of two neighbouring cells that disagree about their shared wall.
enum class SharedWalls { must_agree, average };

/// Gives every cell with i + j even the tuple `even`, every other cell `odd`.
/// @throws InvalidInput under must_agree, naming the first two cells that disagree by more than 1e-9
/// (of t, or rad).
void apply_pattern(Structure& structure, const CellTuple& even, const CellTuple& odd, SharedWalls shared);

}  // namespace kinetix::model
