#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/linkage/axis.hpp"
#include "model/linkage/gripped_rows.hpp"
#include "model/linkage/linkage.hpp"

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
  enum class Kind { none, plates, hinge, cord, shape_memory };

  Kind kind = {};
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
  /// The same drive as far as its coordinate has this value.
  LinkageDrive as_far_as(double coordinate) const;
  /// Its coordinate at theta: compression of the plates; shortening of the cord, mm; turn of the hinge, or that at which
  /// springs rest where the lower body is of class B, rad.
  double coordinate_at(double theta) const;
  /// Its derivative by theta.
  double coordinate_rate(double theta) const;
  /// What a unit of that coordinate is: the flat distance of the plates, mm; 1 mm; 1 rad.
  double travel(const Linkage& linkage) const;
  /// "compression", "mm" or "rad".
  std::string coordinate_unit() const;
  /// As results name it: "compression", "shortened_mm" or "drive_rad".
  std::string coordinate_name() const;
  /// The words before its value in a sentence: "cord shortened by".
  std::string coordinate_words() const;

  /// Whether theta() is the fold parameter of the sheet; else it speaks of the drive alone.
  bool tells_fold() const;
  /// Whether its coordinate grows with the square of theta to both sides of flat, so that `branch` chooses the side.
  bool has_branch() const;
  /// Whether plates hold bodies of it.
  bool has_plates() const;
  /// Whether it goes slack where it would have to push.
  bool only_pulls() const;
  /// Whether its work comes from outside; springs store theirs in the structure.
  bool acts_from_outside() const;
  /// Whether it holds one coordinate of the state: the turn of a hinge, or the length of a cord.
  bool holds_coordinate() const;
  /// Whether its load is a force, N, or a moment, N mm.
  bool has_force() const;
  /// "N" or "N mm".
  std::string load_unit() const { return has_force() ? "N" : "N mm"; }
  /// The body at which rigid motion is held: the lower one of a driven hinge; under a cord or springs, which hold on to nothing
  /// outside, and without a drive the one in the middle of the list. @pre not plates
  int held_body(const Linkage& linkage) const;
  /// Body and coordinate (three turns, three shifts) of all that it prescribes or that rigid motion is held at.
  std::vector<std::array<int, 2>> held_coordinates(const Linkage& linkage) const;
};

}  // namespace kinetix::model
