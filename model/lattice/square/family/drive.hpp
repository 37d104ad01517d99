#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "model/closure/closure_drive.hpp"
#include "model/lattice/square/grip.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

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
/// theta. The run selects the branch: bodies start along the first-order motion of sim/start_motion.hpp, with the
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
/// - For nets, plates that grip a part (model/lattice/square/family/net_grip.hpp). Without such a part, the vertical
/// hinge nearest to its middle among those that turn by twice theta; otherwise by the turn of its crease at theta.
/// - For other sheets, the first vertical hinge, by twice theta.
/// @param theta rad, in (-pi/2, pi/2)
/// @throws InvalidInput for theta outside its range
Drive drive_to(const Structure& structure, double theta);

}  // namespace kinetix::model
