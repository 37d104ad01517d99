#pragma once

#include "model/linkage/exact_motion.hpp"
#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// A rotor on a vertex of the sodalite net, the packing of space by truncated octahedra. It turns about one of the
/// coordinate axes, by twice the fold parameter.
struct SodaliteRotor {
  std::array<int, 3> place;  ///< position in eighths of a cubic cell
  int axis = 0;              ///< 0, 1, 2: x, y, z
  int sign = 1;              ///< direction of its turn as theta grows
};

/// A spatial lattice that shrinks isotropically (kinematics.md section 8), with rotors on the vertices of the
/// sodalite net and gussets on its edges. Gussets never turn. A hinge joins each gusset to each of its two rotors,
/// with the rotor's axis. Bodies are the rotors, then the gussets. Hinge 2 k + e joins gusset k to its rotor e, the
/// lower body. A wall runs from a rotor's vertex to the middle of a gusset.
struct SodaliteStructure {
  CellSize size;             ///< edge_mm: edge of the truncated octahedra, 1 / sqrt(8) of a cubic cell
  std::array<int, 3> cells;  ///< cubic cells along x, y and z
  double gusset = 0.2;       ///< length of a gusset over the edge, at creation
  std::vector<SodaliteRotor> rotors;
  std::vector<std::array<int, 2>> gussets;  ///< rotors of each gusset, ascending
  /// Alpha follows from the net, beta and offset are 0, except in prints
  std::vector<HingeParameters> hinges;
  std::vector<std::array<int, 4>> rings;  ///< rotors around each square of the net: its cells
  std::vector<std::array<int, 8>> ring_bodies, ring_hinges;  ///< per ring: rotor, gusset, rotor, ...

  operator Linkage() const;
};

/// Creates a block of cells. @param gusset length over the edge, in [0.02, 0.9]; hinges are at its ends.
/// @throws InvalidInput for fewer than one cell along a direction, more than 100 000 bodies, a gusset out of range,
/// and sizes that are not positive
SodaliteStructure make_sodalite(std::array<int, 3> cells, double gusset, const CellSize& size);

/// Returns the position of a body at rest, cell edges.
Eigen::Vector3d sodalite_place(const SodaliteStructure& structure, int body);
/// Returns the position of a body at rest, in eighths of a cubic cell.
std::array<int, 3> body_label(const SodaliteStructure& structure, int body);
/// Returns the wall from the rotor to the middle of the gusset.
HingedWall hinged_wall(const SodaliteStructure& structure, int hinge);

/// Checks the hinge parameters. @throws InvalidInput for a t outside (0, 1), and for an alpha, beta or offset that
/// differs from the net's
void validate_hinges(const SodaliteStructure& structure);

/// Returns the closed form: rotors turn by 2 sign theta, gussets do not turn, and positions follow along a tree of
/// walls. There is none if hinges were moved along their walls so that a ring does not close, or if they lean from
/// their rotor's axis.
ExactMotion exact_motion(const SodaliteStructure& structure);

/// Creates plates normal to x or y, on the outermost rotors.
LinkageDrive plate_drive(const SodaliteStructure& structure, Axis axis, double compression, int branch);
/// Creates a drive that turns a gusset relative to its rotor. @param angle rad, in (-pi, pi)
LinkageDrive hinge_drive(const SodaliteStructure& structure, int hinge, double angle);
/// Returns plates along y at their distance in the closed form at theta, rad.
LinkageDrive drive_to(const SodaliteStructure& structure, double theta);

/// Returns a hinge at rest: its axis is the rotor's, at 45 degrees to its wall, except for print errors.
RestHinge rest_hinge(const SodaliteStructure& structure, int hinge);

}  // namespace kinetix::model
