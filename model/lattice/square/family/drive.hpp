#pragma once

#include "model/closure/closure.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A rectangle of lattice vertices, including corners: the part of a structure that plates grip.
struct Grip {
  Vertex first;  ///< lower left
  Vertex last;   ///< upper right
  bool operator==(const Grip&) const = default;

  bool contains(Vertex v) const { return first.i <= v.i && v.i <= last.i && first.j <= v.j && v.j <= last.j; }
};

std::string to_string(const Grip& grip);

/// Checks a grip. @throws InvalidInput unless the rectangle spans at least one cell in both directions and the
/// structure has every vertex of its first and last row along the axis
void validate(const Grip& grip, Axis axis, const Structure& structure);

/// Returns the bodies on the first and on the last row of vertices along the axis, ascending along the row. The rows
/// are those of the grip or, without one, of the whole structure.
GrippedRows gripped_bodies(const Structure& structure, Axis axis, const std::optional<Grip>& grip = {});

/// Part of a net that plates grip, and the direction of the plates.
struct NetGrip {
  Grip grip;
  Axis axis = Axis::y;  ///< normal of the plates
};

/// Returns the part of a net (family F4) that plates grip best; empty if there is none. A candidate is a flat panel
/// of basic cells between plates along its longer side. Another is a spine of any length, one cell wide, between
/// plates along it, in which it bends. The choice is the rectangle with the least total distance of all bodies,
/// counted in walls, because they all swing with it.
std::optional<NetGrip> find_net_grip(const Structure& structure);

/// Checks that plates can hold the gripped rows during an exact motion (keeps_between_plates). Other structures are
/// not checked. @throws InvalidInput if they cannot
void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const std::optional<Grip>& grip);
/// Checks rows that the plates hold. @param what part of the structure bounded by the rows, for the message
void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const GrippedRows& rows, const std::string& what);

/// Drive by two rigid planes normal to `axis` that close in on the structure. They grip the bodies of the first and
/// last row of vertices along the axis, like pins in a frictionless slot. The coordinate of such a body along the
/// axis is prescribed; it slides in the plane and turns freely. The rows are those of the whole structure or of the
/// rectangle `grip`.
///
/// Plates that only press on the outline could not do this. The half walls at the boundary project like wall tips.
/// The outline of M rows has the height L (M cos(theta) + sin(theta)), which grows at first.
///
/// In the exact families a row of vertices stays in one plane normal to the axis if the walls along the row have t =
/// 1/2. A strip that curls into a half circle then stays between its plates. Other fractions make the row a zigzag or
/// a slope: plates would strain such a sheet, and a driven hinge does not. A net is gripped at a part whose rows stay
/// in two planes (keeps_between_plates): a flat panel, or the two long sides of a spine, in which it bends.
///
/// The middle pin of each plate is keyed to the plane z = 0. Otherwise a flat sheet could tip over as a whole between
/// plates that close. The pin of the first plate also does not turn about the plates' normal. Otherwise a sheet could
/// stand on edge and then tip over without strain.
struct Plates {
  Axis axis = Axis::y;             ///< normal of the plates
  double compression = 0;          ///< 1 - final / initial distance, in [0, 1); 1 - cos(theta)
  std::optional<int> branch = {};  ///< sign of theta, 1 or -1; empty: that of the design's theta
  std::optional<Grip> grip = {};   ///< squares: gripped part; empty: the boundary of the structure
  bool press = false;              ///< push the rows and never pull them (LinkageDrive::press)

  bool operator==(const Plates&) const = default;
};

/// Drive by a tendon that runs without friction through the points of hinges and is shortened. It pulls and never
/// pushes.
struct CordPull {
  std::vector<int> through = {};  ///< hinges, in order
  double shorten_mm = 0;          ///< shortening of its whole length
  /// Sign of theta if it pulls equally to both sides; empty: that of the design's theta
  std::optional<int> branch = {};

  bool operator==(const CordPull&) const = default;
};

/// Drive by a spring in each of some hinges, whose rest angle changes from flat to that of a checkerboard.
struct ShapeMemory {
  double angle = 0;               ///< twice the theta of the springs' final rest, rad, in (-pi, pi)
  double k_turn = 0;              ///< stiffness of each spring, N mm/rad
  std::vector<int> springs = {};  ///< hinges with a spring; empty: all

  bool operator==(const ShapeMemory&) const = default;
};

/// Drive that pulls imported bodies, to poses or apart, instead of turning a hinge.
struct BodyPull {
  std::optional<State> poses = {};    ///< one per body, mm
  std::optional<double> expand = {};  ///< times their distance from the middle, as far as possible, > 0
  double tolerance = 0.05;            ///< rms distance from `poses` that counts as reached, cell edges, > 0

  bool operator==(const BodyPull&) const = default;
};

/// Drive of a structure, as in files. A driven hinge leaves the structure floating freely.
///
/// Flat is a singular position: the height changes with theta squared, so it does not distinguish the two signs of
/// theta. The run selects the branch: bodies start along the first-order motion of sim/physics_run.hpp, with the
/// sign of theta. Sublattice A is then pushed about z in that direction and sublattice B against it, with decreasing
/// strength until the drive is complete. A sheet that must strain needs the push, because it buckles only after some
/// travel of its plates.
using Drive = std::variant<Plates, HingeTurn, CordPull, ShapeMemory, BodyPull>;

/// Creates plates on squares.
/// @throws InvalidInput, naming the field, for a value outside its range (NaN included), for a part that they cannot
/// grip, and for hinge parameters out of range
LinkageDrive plate_drive(const Structure& structure, Axis axis, double compression, int branch,
                         const std::optional<Grip>& grip = {});
/// Creates a drive that turns the second body of a wall relative to the first one. @param angle rad, in (-pi, pi)
/// @throws InvalidInput for an angle or hinge parameters out of range
LinkageDrive hinge_drive(const Structure& structure, int hinge, double angle);

/// Returns the drive that turns the bodies at a wall by theta, rad, (-pi/2, pi/2).
/// @throws InvalidInput for a wall that is not in the structure
HingeTurn hinge_drive_to(const Structure& structure, const Wall& wall, double theta);
/// Returns drives for a search without knowledge of the structure: its first upright hinge (or its first one) to
/// theta and to -theta. @param theta rad, (0, pi/2)
std::vector<Drive> search_drives(const Structure& structure, double theta);

/// Returns the drive that takes an exactly mobile structure to fold angle theta:
/// - For planar sheets, plates whose rows stay straight, if there are any.
/// - Plates normal to the direction in which its rows are stacked (y; x if the sheet folds along y). This needs a
/// flat and straight boundary, or a rectangle without an exact family, or a sheet without vertical hinges.
/// - For nets, plates that grip a part (model/lattice/square/family/drive.hpp). Without such a part, the vertical
/// hinge nearest to its middle among those that turn by twice theta; otherwise by the turn of its crease at theta.
/// - For other sheets, the first vertical hinge, by twice theta.
/// @param theta rad, in (-pi/2, pi/2)
/// @throws InvalidInput for theta outside its range
Drive drive_to(const Structure& structure, double theta);

}  // namespace kinetix::model
