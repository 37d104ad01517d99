#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "model/closure/closure_drive.hpp"
#include "model/lattice/square/grip.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Two rigid planes normal to `axis` close in on the structure. They grip the bodies of the first
/// and of the last row of vertices along the axis, of the whole structure or of the rectangle `grip`, like
/// pins in a frictionless slot: such a body's coordinate along the axis is prescribed, and it is free to
/// slide in the plane and to turn. Plates that merely press on the outline could not do this: the half walls
/// at the rim stick out like wall tips, so that the outline of M rows has the height L (M cos(theta) +
/// sin(theta)), which grows at first. In the exact families a row of vertices stays in one plane normal to
/// the axis as long as the walls along the row have t = 1/2, so a strip that curls into a half circle stays
/// between its plates. Other fractions make the row a zigzag or a slope: plates would strain such a sheet,
/// and a driven hinge does not. A net is gripped at a part whose rows stay in two planes
/// (keeps_between_plates): a flat panel, or a spine at its two long sides, which it bends in. The middle pin
/// of each plate is keyed to the plane z = 0. Without it, nothing would keep a flat sheet from tipping over
/// as a whole between plates that come closer. That of the first plate does not turn about the plates' normal
/// either: a sheet could stand up on edge, and then tip over at no strain.
struct Plates {
  Axis axis = Axis::y;             ///< their normal
  double compression = 0;          ///< 1 - final / initial distance, in [0, 1); 1 - cos(theta)
  std::optional<int> branch = {};  ///< sign of theta, 1 or -1; nothing: that of the design's theta
  std::optional<Grip> grip = {};   ///< of squares: what they grip; nothing: the rim of the structure
  bool press = false;              ///< push their rows and never pull them (LinkageDrive::press)

  bool operator==(const Plates&) const = default;
};

/// A cord that runs without friction through the points of hinges gets shorter. It pulls and never pushes.
struct CordPull {
  std::vector<int> through = {};  ///< the hinges, in order
  double shorten_mm = 0;          ///< of its whole length
  std::optional<int> branch =
      {};  ///< sign of theta where it pulls to both sides alike; nothing: that of the design's theta

  bool operator==(const CordPull&) const = default;
};

/// A spring of its own in each of some hinges, whose rest angle goes from flat to that of a checkerboard.
struct ShapeMemory {
  double angle = 0;               ///< twice the theta at which springs rest in the end, rad, in (-pi, pi)
  double k_turn = 0;              ///< of each spring, N mm/rad
  std::vector<int> springs = {};  ///< the hinges that have one; empty: all

  bool operator==(const ShapeMemory&) const = default;
};

/// Imported bodies that are pulled, to poses or apart, in place of a hinge that is turned.
struct BodyPull {
  std::optional<State> poses = {};    ///< one a body, mm
  std::optional<double> expand = {};  ///< times their distance from the middle, as far as they go, > 0
  double tolerance = 0.05;            ///< rms from `poses` that counts as there, cell edges, > 0

  bool operator==(const BodyPull&) const = default;
};

/// What moves a structure, as files say it. A hinge that is turned leaves the structure floating freely.
///
/// Flat is a singular position: the height changes with theta squared and does not tell the two signs of
/// theta apart. The run chooses the branch on purpose: the bodies start along the first-order motion of
/// sim/start_motion.hpp, with the sign of theta, and class A is pushed on about z that way and class B
/// against it, ever less, until the drive is through. A sheet that must strain needs the push, since it
/// buckles only after its plates have come some way.
using Drive = std::variant<Plates, HingeTurn, CordPull, ShapeMemory, BodyPull>;

/// Plates on squares. @throws InvalidInput, naming the field, for a value outside its range (NaN included), for a part that
/// they cannot grip, and for hinge parameters out of range
LinkageDrive plate_drive(const Structure& structure, Axis axis, double compression, int branch,
                         const std::optional<Grip>& grip = {});
/// The second body of a wall turned against the first one. @param angle rad, in (-pi, pi)
/// @throws InvalidInput for an angle or hinge parameters out of range
LinkageDrive hinge_drive(const Structure& structure, int hinge, double angle);

/// The drive that turns the bodies at a wall by theta, rad, (-pi/2, pi/2).
/// @throws InvalidInput for a wall that the structure does not have
HingeTurn hinge_drive_to(const Structure& structure, const Wall& wall, double theta);
/// Drives for a search that knows nothing of the structure: its first upright hinge (else its first one) to
/// theta and to -theta. @param theta rad, (0, pi/2)
std::vector<Drive> search_drives(const Structure& structure, double theta);

/// The drive that takes an exactly mobile structure to fold angle theta. Plates normal to the direction in
/// which its rows are stacked (y; x where the sheet folds along y) if its rim stays flat and is not ragged,
/// or if it is a rectangle without an exact family; for other sheets the first vertical hinge, by twice
/// theta. For nets plates that grip a part of it (model/lattice/square/family/net_grip.hpp), or where there is no
/// such part the vertical hinge nearest to its middle of those that turn by twice theta, else by as much as
/// its crease does at theta.
/// @param theta rad, in (-pi/2, pi/2)
/// @throws InvalidInput for theta outside its range
Drive drive_to(const Structure& structure, double theta);

}  // namespace kinetix::model
