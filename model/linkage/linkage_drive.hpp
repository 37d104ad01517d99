#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/linkage/axis.hpp"
#include "model/linkage/gripped_rows.hpp"
#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// Returns the turn of a hinge about its axis at fold parameter theta, if its bodies turn by +-theta: upper
/// body relative to the lower one, rad. @param sense of the lower body   @param theta rad
inline double turn_at_theta(int sense, double theta) { return -2 * sense * theta; }
/// Returns the theta, rad, at which a hinge has this turn, rad. @param sense of the lower body
inline double theta_at_turn(int sense, double turn) { return -sense * turn / 2; }

/// Drive of a linkage from flat, in terms of its bodies and hinges. A lattice creates it from a Drive.
///
/// **plates**: two parallel planes normal to `axis` close in, cos(theta) times as far apart as at rest. Each
/// prescribes the coordinate along the axis of the bodies it grips.
/// Plates that **press** do not grip: they push these bodies, each at its vertex, and never pull. A body may
/// leave its plate, and no friction holds it.
/// **hinge**: the upper body of one hinge turns about the hinge axis relative to the lower one.
/// **cord**: a tendon runs without friction through the points of hinges, and its whole length is shortened.
/// It pulls and never pushes.
/// **shape memory**: each of some hinges has a spring, whose rest angle changes from flat to that of a
/// checkerboard.
/// **none**: no actuation; one body is held.
struct LinkageDrive {
  enum class Kind { none, plates, hinge, cord, shape_memory };

  Kind kind = {};
  Axis axis = Axis::y;         ///< plates: normal of the plates
  double compression = 0;      ///< plates: 1 - final / initial distance, in [0, 1)
  int branch = 1;              ///< plates, tendon: +1 or -1, the sign of theta
  GrippedRows gripped = {};    ///< plates: bodies of the first and second plate; each has one rest coordinate
  bool press = false;          ///< plates: push the `gripped` bodies, and release them instead of pulling
  bool grips_part = false;     ///< plates: a part of the structure, not its whole boundary
  std::vector<int> held = {};  ///< plates: all bodies of that part, or of the structure; ascending
  int hinge = -1;              ///< hinge: index of the driven hinge
  int sense = 1;               ///< hinge: sense of its lower body
  double angle = 0;  ///< hinge: its turn; shape memory: twice the springs' rest theta; rad, in (-pi, pi)
  std::vector<int> through = {};  ///< tendon: hinges through whose points it runs, in order
  double rest_mm = 0;             ///< tendon: length in the flat state
  double shorten_mm = 0;          ///< tendon: amount of shortening, in [0, rest_mm)
  std::vector<int> springs = {};  ///< shape memory: hinges with a spring; ascending
  double k_spring = 0;            ///< shape memory: stiffness of each spring, N mm/rad

  /// Returns theta, rad: the signed turn of the bodies at the drive's target. For a tendon a straight one is
  /// then cos(theta) times as long. For shape memory it is the theta at which the springs rest; the hinges
  /// limit how closely the sheet reaches it.
  double theta() const;
  /// Returns a copy of the drive with its target at another theta(), rad. The sign of theta sets the branch
  /// of plates and tendon.
  LinkageDrive to(double theta) const;
  /// Returns a copy of the drive with its target at this value of the coordinate.
  LinkageDrive as_far_as(double coordinate) const;
  /// Returns the coordinate at theta: compression of the plates, shortening of the tendon in mm, or turn of
  /// the hinge in rad. For springs it is the rest angle, rad, of a hinge whose lower body has sense -1.
  double coordinate_at(double theta) const;
  /// Returns the derivative of the coordinate by theta.
  double coordinate_rate(double theta) const;
  /// Returns the length or angle per unit of the coordinate: the flat distance of the plates, mm; 1 mm; 1
  /// rad.
  double travel(const Linkage& linkage) const;
  /// Returns "compression", "mm" or "rad".
  std::string coordinate_unit() const;
  /// Returns the name of the coordinate in results: "compression", "shortened_mm" or "drive_rad".
  std::string coordinate_name() const;
  /// Returns the words before its value in a sentence, for example "cord shortened by".
  std::string coordinate_words() const;

  /// Returns true if theta() is the fold parameter of the sheet; otherwise it describes the drive alone.
  bool tells_fold() const;
  /// Returns true if its coordinate grows with the square of theta to both sides of flat, so that `branch`
  /// selects the side.
  bool has_branch() const;
  /// Returns true if plates hold bodies.
  bool has_plates() const;
  /// Returns true if the drive becomes slack instead of pushing.
  bool only_pulls() const;
  /// Returns true if its work is external; springs store theirs in the structure.
  bool acts_from_outside() const;
  /// Returns true if it prescribes one coordinate of the state: the turn of a hinge, or the length of a
  /// tendon.
  bool holds_coordinate() const;
  /// Returns true if its load is a force, N; otherwise it is a moment, N mm.
  bool has_force() const;
  /// Returns "N" or "N mm".
  std::string load_unit() const { return has_force() ? "N" : "N mm"; }
  /// Returns the body that removes rigid motion. For a driven hinge it is the lower body. Otherwise it is the
  /// middle of the list, because a tendon and springs have no external support. @pre not plates
  int held_body(const Linkage& linkage) const;
  /// Returns body and coordinate (0-2: turns, 3-5: shifts) of each value that is prescribed or held against
  /// rigid motion.
  std::vector<std::array<int, 2>> held_coordinates(const Linkage& linkage) const;
};

}  // namespace kinetix::model
