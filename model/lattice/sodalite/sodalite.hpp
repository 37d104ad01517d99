#pragma once

#include <array>
#include <vector>

#include "model/linkage/exact_motion.hpp"
#include "model/linkage/hinge_parameters.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/wall.hpp"

namespace kinetix::model {

/// A rotor on a vertex of the sodalite net, the packing of space by truncated octahedra: it turns about one of the axes of
/// space, by twice the fold parameter.
struct SodaliteRotor {
  std::array<int, 3> place;  ///< in eighths of a cubic cell
  int axis = 0;              ///< 0, 1, 2: x, y, z
  int sign = 1;              ///< which way it turns as theta grows
};

/// A lattice in space that shrinks alike in all directions (kinematics.md section 8): rotors on the vertices of the
/// sodalite net, gussets on its edges, which never turn. Each gusset hangs on its two rotors by a hinge each, whose axis is
/// the rotor's. Bodies are the rotors, then the gussets; hinge 2 k + e joins gusset k to its rotor e, the lower body. A wall
/// runs from a rotor's vertex to the middle of a gusset.
struct SodaliteStructure {
  CellSize size;  ///< edge_mm: of the truncated octahedra, a third of a cubic cell and more (1 / sqrt(8))
  std::array<int, 3> cells;  ///< cubic cells along x, y and z
  double gusset = 0.2;       ///< length of a gusset over the edge, as the lattice was made
  std::vector<SodaliteRotor> rotors;
  std::vector<std::array<int, 2>> gussets;  ///< the rotors that each joins, ascending
  std::vector<HingeParameters> hinges;  ///< alpha follows from the net, beta and offset are 0, but in prints
  std::vector<std::array<int, 4>> rings;  ///< rotors round each square of the net: its cells
  std::vector<std::array<int, 8>> ring_bodies, ring_hinges;  ///< of each: rotor, gusset, rotor, ...

  operator Linkage() const;
};

/// @param gusset length over the edge, in [0.02, 0.9]; hinges sit at its ends
/// @throws InvalidInput for fewer than one cell along a direction, more than 100 000 bodies, a gusset out of range, and
/// sizes that are not positive
SodaliteStructure make_sodalite(std::array<int, 3> cells, double gusset, const CellSize& size);

/// Of a body at rest, cell edges.
Eigen::Vector3d sodalite_place(const SodaliteStructure& structure, int body);
/// In eighths of a cubic cell.
std::array<int, 3> body_label(const SodaliteStructure& structure, int body);
/// From the rotor to the middle of the gusset.
HingedWall hinged_wall(const SodaliteStructure& structure, int hinge);

/// @throws InvalidInput for a t outside (0, 1), and for an alpha, beta or offset that is not the net's own
void validate_hinges(const SodaliteStructure& structure);

/// The closed form: rotors turn by 2 sign theta, gussets not at all; places follow along a tree of walls. None where hinges
/// were moved along their walls so that a ring does not close, or lean from their rotor's axis.
ExactMotion exact_motion(const SodaliteStructure& structure);

/// Plates normal to x or y, on the outermost rotors.
LinkageDrive plate_drive(const SodaliteStructure& structure, Axis axis, double compression, int branch);
/// A gusset turned against its rotor. @param angle rad, in (-pi, pi)
LinkageDrive hinge_drive(const SodaliteStructure& structure, int hinge, double angle);
/// Plates along y that have come as close as the closed form has them at theta, rad.
LinkageDrive drive_to(const SodaliteStructure& structure, double theta);

}  // namespace kinetix::model
