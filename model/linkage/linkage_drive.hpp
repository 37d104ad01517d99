#pragma once

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Bodies gripped by the first and by the second plate, each in ascending order along the plate.
using GrippedRows = std::array<std::vector<int>, 2>;

/// Two parallel planes that fit two rows best in a state, relative to their distance.
struct RowPlanes {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit vector, from the first row to the last
  double distance = 0;                                ///< distance of the planes, mm
  double off_plane = 0;                               ///< largest distance of a body from its plane, mm
};

/// Returns the planes of two rows. If several pairs fit, as for two parallel straight rows, the pair furthest
/// apart is returned.
/// @pre at least two bodies per row; a finite state
RowPlanes planes_of(const GrippedRows& rows, const State& state);

/// Returns true if plates can hold the rows during an exact motion: in two parallel planes, cos(theta) times
/// as far apart as at rest. Rows that bend towards each other give false, because their sheet would roll
/// between the plates.
/// @param fold state at theta, rad
bool keeps_between_plates(const Linkage& structure, const GrippedRows& rows,
                          const std::function<State(double)>& fold);

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
  LinkageDrive limited_to(double coordinate) const;
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
  std::string describe_coordinate() const;

  /// Returns true if theta() is the fold parameter of the sheet; otherwise it describes the drive alone.
  bool determines_fold() const;
  /// Returns true if its coordinate grows with the square of theta to both sides of flat, so that `branch`
  /// selects the side.
  bool has_branch() const;
  /// Returns true if plates hold bodies.
  bool has_plates() const;
  /// Returns true if the drive becomes slack instead of pushing.
  bool only_pulls() const;
  /// Returns true if its work is external; springs store theirs in the structure.
  bool is_external() const;
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

/// Creates plates that hold two rows of a whole linkage and approach each other.
/// @param compression 1 - distance / distance at rest, [0, 1)   @param branch 1 or -1, sign of theta
/// @param bodies number of bodies of the linkage
/// @throws InvalidInput for a compression or branch out of range
LinkageDrive plates_between(GrippedRows rows, Axis axis, double compression, int branch, int bodies);

/// Creates a drive that turns one hinge. @param sense of its lower body, 1 or -1   @param angle rad, in (-pi,
/// pi)
/// @throws InvalidInput for an angle out of range
LinkageDrive turned_hinge(int hinge, int sense, double angle);

/// Drives that act on hinges of any lattice: a tendon along several hinges, or a spring in each hinge.

/// Returns the point of a hinge midway between the positions carried by its two bodies, mm.
Eigen::Vector3d hinge_point(const Linkage& linkage, int hinge, const State& state);
/// Returns the length of a tendon from hinge point to hinge point, mm. @param through hinges, in the order of
/// the tendon
double cord_length(const Linkage& linkage, const std::vector<int>& through, const State& state);

/// Creates a drive that shortens a tendon through the points of hinges by `shorten_mm`.
/// @param branch 1 or -1, the sign of theta if the tendon pulls equally to either side.
/// @throws InvalidInput for fewer than two hinges, for a hinge twice in a row, and for a shortening that
/// leaves no tendon.
/// @throws InvalidInput if no two neighbouring points are on different bodies, which keeps the length constant
LinkageDrive cord_drive(const Linkage& linkage, const std::vector<int>& through, double shorten_mm,
                        int branch = 1);

/// Creates a drive by a spring in each of these hinges. At the end it rests at the hinge's turn_at_theta for
/// theta = angle / 2.
/// @param hinges empty: all   @param k_turn of each spring, N mm/rad   @param angle rad, in (-pi, pi)
/// @throws InvalidInput for numbers out of range, and for a hinge named twice
LinkageDrive shape_memory_drive(const Linkage& linkage, std::vector<int> hinges, double k_turn, double angle);

}  // namespace kinetix::model
