#pragma once

#include <optional>

#include "model/lattice/square/grip.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// How a compression run moves a structure from flat to the state it is to settle in.
///
/// **plates**: two rigid planes normal to `axis` close in on the structure. They grip the bodies of the first
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
///
/// **hinge**: the two bodies of one wall are turned against each other about the hinge axis they share. The
/// structure floats freely.
///
/// Flat is a singular position: the height changes with theta squared and does not tell the two signs of
/// theta apart. The run chooses the branch on purpose: the bodies start along the first-order motion of
/// sim/start_motion.hpp, with the sign of theta, and class A is pushed on about z that way and class B
/// against it, ever less, until the drive is through. A sheet that must strain needs the push, since it
/// buckles only after its plates have come some way.
struct Drive {
  using Kind = LinkageDrive::Kind;

  Kind kind = Kind::plates;
  Axis axis = Axis::y;  ///< plates: normal of the plates
  double compression =
      0.0;         ///< plates: 1 - final / initial distance of the plates, in [0, 1); 1 - cos(theta)
  int branch = 1;  ///< plates: +1 or -1, the sign of theta
  std::optional<Grip> grip = {};  ///< plates: what they grip; nothing: the rim of the structure
  bool press = false;             ///< plates: push their rows and never pull them (LinkageDrive::press)
  Wall wall;                      ///< hinge: the driven wall
  double angle = 0.0;  ///< hinge: turn of wall.to() against wall.from about the hinge axis, rad, in
                       ///< (-pi, pi). A basic hinge has -2 theta where wall.from is class A.

  /// Magnitude with sign of the turn of the bodies that the whole drive asks for, rad: theta. Of a driven
  /// hinge half its turn, which is theta where it is vertical and no crease that bends crosses another.
  double theta() const;
  /// The same by bodies and hinges of the structure.
  /// @throws InvalidInput for what validate() refuses and for hinge parameters out of range
  LinkageDrive on(const Structure& structure) const;
};

/// A structure under drives, with its closed form where it belongs to an exact family. @throws as Drive::on
DrivenLinkage driven(const Structure& structure, const Drive& drive);
std::vector<DrivenLinkage> driven(const Structure& structure, const std::vector<Drive>& drives);

/// The drive that turns the bodies at a wall by theta, rad, (-pi/2, pi/2).
Drive hinge_drive_to(const Wall& wall, double theta);
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

/// @throws InvalidInput, naming the field, for a value outside its range (NaN included) or a driven wall that
/// the structure does not have.
void validate(const Drive& drive, const Structure& structure);

}  // namespace kinetix::model
