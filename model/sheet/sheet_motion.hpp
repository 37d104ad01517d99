#pragma once

#include <functional>
#include <optional>

#include "model/lattice/square/grip.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/sheet/sheet.hpp"

namespace kinetix::model {

/// The sheet as a structure on a planar graph: bodies and hinges in the same order, cells first.
PlanarStructure planar_structure(const Sheet& sheet);
/// Puts the hinges of a sheet where y, of each body, has them; alpha and beta stay.
void place_hinges(const std::vector<Eigen::Vector2d>& y, Sheet& sheet);

/// The closed form of a sheet, by the rules of its lattice. Imported bodies have none: they follow their drive step by step.
ExactMotion exact_motion(const Sheet& sheet);

/// How a sheet is driven, as files say it (see LinkageDrive).
struct SheetDrive {
  LinkageDrive::Kind kind = LinkageDrive::Kind::plates;
  Axis axis = Axis::y;            ///< plates: their normal
  double compression = 0;         ///< plates: 1 - final / initial distance, in [0, 1)
  int branch = 1;                 ///< plates, cord: 1 or -1, the sign of theta
  std::optional<Grip> grip = {};  ///< plates: the part of squares that they grip; nothing: the rim
  bool press = false;             ///< plates: push their rows and never pull them
  int hinge =
      -1;  ///< hinge: the driven one; -1, of imported bodies: that which turns most in the first motion
  double angle = 0;  ///< hinge: its turn; shape memory: twice theta of its springs; rad, in (-pi, pi)
  std::vector<int> through = {};  ///< cord: the hinges through which it runs
  double shorten_mm = 0;          ///< cord
  std::vector<int> springs = {};  ///< shape memory: the hinges that have one; empty: all
  double k_turn = 0;              ///< shape memory: of each spring, N mm/rad
};

/// The drive by bodies and hinges. A cord that pulls an exactly moving sheet to one side of flat goes there.
/// @throws InvalidInput for values out of range, plates that find nothing to hold, and a cord that nothing shortens
LinkageDrive drive_on(const Sheet& sheet, const SheetDrive& drive);

/// The drive that takes a sheet to theta, rad, in (-pi/2, pi/2), the one that folds its lattice most evenly.
LinkageDrive drive_to(const Sheet& sheet, double theta);

/// A sheet under its drive while its hinges change bit by bit from those of `before` to those of `after`: part 0
/// to part 1. @pre both have the same cells and sizes
std::function<DrivenLinkage(double part)> changing(const Sheet& before, const Sheet& after,
                                                   const LinkageDrive& drive);

}  // namespace kinetix::model
