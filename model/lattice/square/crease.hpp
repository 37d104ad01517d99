#pragma once

#include "model/hinge/crease_law.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Opposite walls of cells in line: x-walls along a column of cells, y-walls along a row. A fold line can only run
/// through all of them. Their tilts are equal except for the sign, which alternates along the line (kinematics.md
/// section 2). With tilt 0 the line is part of a flat panel.
struct Crease {
  Axis axis = Axis::x;      ///< axis of its walls; the fold line itself runs across
  std::vector<int> hinges;  ///< ascending
};

struct Creases {
  std::vector<Crease> list;   ///< in the order of their first hinges
  std::vector<int> of_hinge;  ///< index in list
};

/// Returns the creases of a structure; every hinge is in one. An interrupted line of cells has two.
Creases find_creases(const Structure& structure);

/// Returns the column of a crease of x-walls, or the row of a crease of y-walls.
int line_of(const Structure& structure, const Crease& crease);

/// Returns +1 or -1: the tilt of a wall in a crease of tilt b is alternation * b. It is -1 on x-walls of odd row and
/// on y-walls of odd column.
int alternation(const Wall& wall);

/// Returns the tilt b, rad, of the crease that the hinge would be part of.
inline double tilt_in_crease(const Hinge& hinge) { return alternation(hinge.wall) * hinge.parameters.beta; }

/// Gives the walls of a crease the tilt, rad, by alternation, at t = 1/2 and alpha = 90 deg.
void set_tilt(Structure& structure, const Crease& crease, double tilt);

/// Returns +1 if a positive tilt of the wall's crease lowers its far side (towards +x or +y) as theta grows from 0,
/// -1 if it raises it. All walls of a crease have the same value. Its product with crease_turn
/// (model/hinge/crease_law.hpp) is the turn of the far side below the plane of the near one.
int turn_sense(const Wall& wall);

}  // namespace kinetix::model
