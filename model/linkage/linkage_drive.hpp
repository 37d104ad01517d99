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
/// **cord**: a cord runs without friction through the points of hinges, and its whole length is shortened. It pulls and
/// never pushes.
/// **shape memory**: a spring of its own in each of some hinges, whose rest angle goes from flat to that of a checkerboard.
/// **none**: nothing moves it, one body is held.
struct LinkageDrive {
  enum class Kind { plates, hinge, cord, shape_memory, none };

  Kind kind = Kind::plates;
  Axis axis = Axis::y;     ///< plates: their normal
  double compression = 0;  ///< plates: 1 - final / initial distance, in [0, 1)
  int branch = 1;          ///< plates, cord: +1 or -1, the sign of theta
  GrippedRows gripped =
      {};              ///< plates: bodies of the first and of the second one; of one coordinate each at rest
  bool press = false;  ///< plates: push what `gripped` names, and let it go where they would have to pull
  bool grips_part = false;     ///< plates: a part of the structure, not its whole rim
  std::vector<int> held = {};  ///< plates: all bodies of that part, or of the structure; ascending
  int hinge = -1;              ///< hinge: the driven one
  int sense = 1;               ///< hinge: of its lower body
  double angle =
      0;  ///< hinge: its turn; shape memory: twice the theta at which springs rest; rad, in (-pi, pi)
  std::vector<int> through = {};  ///< cord: the hinges through whose points it runs, in its order
  double rest_mm = 0;             ///< cord: its length in the flat state
  double shorten_mm = 0;          ///< cord: by how much, in [0, rest_mm)
  std::vector<int> springs = {};  ///< shape memory: the hinges that have one; ascending
  double k_spring = 0;            ///< shape memory: of each, N mm/rad

  /// Magnitude with sign of the turn of the bodies that the whole drive asks for, rad: theta. Of a cord that at which a
  /// straight one is cos(theta) times as long; of shape memory that at which its springs rest, which the sheet comes to
  /// as far as its hinges let it.
  double theta() const;
  /// The same drive as far as another theta(), rad, of which plates and a cord take the sign as their branch.
  LinkageDrive to(double theta) const;
  bool pulls_cord() const { return kind == Kind::cord; }
  bool heats_springs() const { return kind == Kind::shape_memory; }
  /// Whether theta() tells of the drive alone, neither how far nor to which side the sheet is folded.
  bool has_own_theta() const { return pulls_cord() || heats_springs(); }
  /// Whether its load is a force, N, or a moment, N mm.
  bool has_force() const { return kind == Kind::plates || kind == Kind::cord; }
  /// "N" or "N mm".
  std::string load_unit() const { return has_force() ? "N" : "N mm"; }
  /// Of its coordinate as EquilibriumStep has it: "compression", "mm" or "rad".
  std::string coordinate_unit() const;
};

}  // namespace kinetix::model
