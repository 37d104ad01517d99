#pragma once

#include <functional>
#include <vector>

#include "model/lattice/lattice.hpp"
#include "model/lattice/square/family/drive.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// The sheet as a structure on a planar graph: bodies and hinges in the same order, cells first.
PlanarStructure planar_structure(const Lattice& sheet);
/// Puts the hinges of a sheet where y, of each body, has them; alpha and beta stay.
void place_hinges(const std::vector<Eigen::Vector2d>& y, Lattice& sheet);

/// The closed form of a sheet, by the rules of its lattice. Imported bodies have none: they follow their drive step by step.
ExactMotion exact_motion(const Lattice& sheet);

/// The drive by bodies and hinges; none for bodies that are pulled (model/assembly/deployment.hpp). A cord that pulls an
/// exactly moving sheet to one side of flat goes there.
/// @param theta of the design, whose sign a drive takes that names no branch
/// @throws InvalidInput for values out of range, plates that find nothing to hold, and a cord that nothing shortens
LinkageDrive drive_on(const Lattice& sheet, const Drive& drive, double theta = 0);

/// The same drive as far as `shown`, which was made of it.
Drive as_far_as(const LinkageDrive& shown, Drive drive);
/// The same drive of a sheet so many times as large.
Drive scaled(Drive drive, double factor);
/// Whether nothing but elastic hinges stands against the drive: springs, and plates that press.
bool needs_elastic_hinges(const Drive& drive);
/// Stiffness of each spring that the drive brings along, N mm/rad; 0 where it brings none.
double spring_stiffness(const Drive& drive);

/// A sheet under a drive, with its closed form where it belongs to an exact family. @throws as drive_on
DrivenLinkage driven(const Lattice& sheet, const Drive& drive);
/// The same of each.
std::vector<DrivenLinkage> driven(const Lattice& sheet, const std::vector<Drive>& drives);

/// The drive that takes a sheet to theta, rad, in (-pi/2, pi/2), the one that folds its lattice most evenly.
LinkageDrive drive_to(const Lattice& sheet, double theta);

/// A sheet under its drive while its hinges change bit by bit from those of `before` to those of `after`: part 0
/// to part 1. @pre both have the same cells and sizes
std::function<DrivenLinkage(double part)> changing(const Lattice& before, const Lattice& after,
                                                   const LinkageDrive& drive);

}  // namespace kinetix::model
