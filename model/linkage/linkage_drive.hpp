#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/linkage/axis.hpp"
#include "model/linkage/gripped_rows.hpp"

namespace kinetix::model {

/// Turn of a hinge about its axis at fold parameter theta, where its bodies turn by +-theta: upper body
/// against lower one, rad. @param sense of the lower body   @param theta rad
inline double turn_at_theta(int sense, double theta) { return -2 * sense * theta; }
/// And back: theta, rad, at which the hinge has this turn, rad.
inline double theta_at_turn(int sense, double turn) { return -sense * turn / 2; }

/// How a linkage is driven from flat, by its bodies and hinges: what a lattice makes of a Drive.
///
/// **plates**: two parallel planes normal to `axis` close in, cos(theta) times as far apart as at rest, each
/// prescribing the coordinate along the axis of the bodies it grips.
/// Plates that **press** do not grip: they push these bodies, each at its vertex, and never pull them, so that a body
/// may leave its plate; no friction holds it where it is.
/// **hinge**: the upper body of one hinge is turned about the hinge axis against the lower one.
struct LinkageDrive {
  enum class Kind { plates, hinge };

  Kind kind = Kind::plates;
  Axis axis = Axis::y;     ///< plates: their normal
  double compression = 0;  ///< plates: 1 - final / initial distance, in [0, 1)
  int branch = 1;          ///< plates: +1 or -1, the sign of theta
  GrippedRows gripped;  ///< plates: bodies of the first and of the second one; of one coordinate each at rest
  bool press = false;   ///< plates: push what `gripped` names, and let it go where they would have to pull
  bool grips_part = false;  ///< plates: a part of the structure, not its whole rim
  std::vector<int> held;    ///< plates: all bodies of that part, or of the structure; ascending
  int hinge = -1;           ///< hinge: the driven one
  int sense = 1;            ///< hinge: of its lower body
  double angle = 0;         ///< hinge: its turn, rad, in (-pi, pi)

  /// Magnitude with sign of the turn of the bodies that the whole drive asks for, rad: theta.
  double theta() const;
};

}  // namespace kinetix::model
