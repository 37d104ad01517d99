#pragma once

#include <vector>

#include "model/hinge/crease_law.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Walls that lie opposite each other in cells, from cell to cell: x-walls along a column of cells, y-walls
/// along a row. A fold line can only run through all of them, their tilts alike but for the sign, which
/// alternates along it (kinematics.md section 2). With tilt 0 it is part of a flat panel.
struct Crease {
  Axis axis = Axis::x;      ///< of its walls; the fold line itself runs across
  std::vector<int> hinges;  ///< ascending
};

struct Creases {
  std::vector<Crease> list;   ///< in the order of their first hinges
  std::vector<int> of_hinge;  ///< index in list
};

/// The creases of a structure; every hinge is in one. A line of cells that is interrupted has two.
Creases find_creases(const Structure& structure);

/// Column of a crease of x-walls, row of one of y-walls.
int line_of(const Structure& structure, const Crease& crease);

/// +1 or -1: the tilt of a wall in a crease of tilt b is alternation * b. -1 on x-walls of odd row, on
/// y-walls of odd column.
int alternation(const Wall& wall);

/// Of the crease that the hinge would be part of, rad: b as above.
inline double tilt_in_crease(const Hinge& hinge) { return alternation(hinge.wall) * hinge.parameters.beta; }

/// Gives the walls of a crease the tilt, rad, by alternation, at t = 1/2 and alpha = 90 deg.
void set_tilt(Structure& structure, const Crease& crease, double tilt);

/// +1 where a positive tilt of the wall's crease lowers its far side (towards +x or +y) as theta grows from
/// 0, -1 where it raises it. The same for all walls of a crease. Times crease_turn
/// (model/hinge/crease_law.hpp) it is how far the far side turns below the plane of the near one.
int turn_sense(const Wall& wall);

}  // namespace kinetix::model
