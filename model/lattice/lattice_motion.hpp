#pragma once

#include <functional>
#include <vector>

#include "model/lattice/lattice.hpp"
#include "model/lattice/square/family/drive.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Returns the sheet as a structure on a planar graph: bodies and hinges in the same order, cells first.
PlanarStructure planar_structure(const Lattice& sheet);
/// Places the hinges of a sheet by y, given for each body; alpha and beta do not change.
void place_hinges(const std::vector<Eigen::Vector2d>& y, Lattice& sheet);

/// Returns the closed form of a sheet, by the rules of its lattice. Imported bodies have none and follow their drive
/// step by step.
ExactMotion exact_motion(const Lattice& sheet);

/// Returns the drive in terms of bodies and hinges; kind none for bodies that are pulled
/// (model/assembly/deployment.hpp). A tendon that pulls an exactly moving sheet to one side of flat takes that side.
/// @param theta theta of the design: its sign is the default branch.
/// @throws InvalidInput for values out of range, plates without rows to hold, and a tendon that cannot be shortened
LinkageDrive drive_on(const Lattice& sheet, const Drive& drive, double theta = 0);

/// Returns the drive with its end point at that of `shown`, which was created from it.
Drive as_far_as(const LinkageDrive& shown, Drive drive);
/// Returns the drive of a sheet scaled by `factor`.
Drive scaled(Drive drive, double factor);
/// Returns true if only elastic hinges resist the drive: springs, and plates that press.
bool needs_elastic_hinges(const Drive& drive);
/// Returns the stiffness of each spring of the drive, N mm/rad; 0 without springs.
double spring_stiffness(const Drive& drive);

/// Returns a sheet under a drive, with its closed form if it belongs to an exact family. @throws as drive_on
DrivenLinkage driven(const Lattice& sheet, const Drive& drive);
/// Returns the sheet under each of the drives.
std::vector<DrivenLinkage> driven(const Lattice& sheet, const std::vector<Drive>& drives);

/// Returns the drive that folds the lattice most evenly to theta, rad, in (-pi/2, pi/2).
LinkageDrive drive_to(const Lattice& sheet, double theta);

/// Returns a sheet under its drive as a function of `part`: its hinges change gradually from those of `before` (part
/// 0) to those of `after` (part 1). @pre both have the same cells and sizes
std::function<DrivenLinkage(double part)> changing(const Lattice& before, const Lattice& after,
                                                   const LinkageDrive& drive);

}  // namespace kinetix::model
