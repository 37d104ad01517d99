#pragma once

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
Drive limited_to(const LinkageDrive& shown, Drive drive);
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

/// Returns the turn law of every hinge along the sheet's exact motion. @pre exact_motion(sheet) has one
std::vector<TurnLaw> turn_laws(const Lattice& sheet);

/// A drive to try on a sheet, or the reason why there is none of its kind.
struct TrialDrive {
  std::string name;  ///< e.g. "cord along the middle row"
  std::optional<LinkageDrive> drive;
  std::string why_not;  ///< one sentence, if there is no drive
};

/// Returns drives that take a sheet to theta: plates normal to y and to x, and the hinges nearest to and farthest
/// from its middle. Squares also have tendons along the middle row and column of cells, across an even number of
/// them. Across an odd number a tendon would pull to one side from the start. If the sheet moves exactly, each drive
/// has the target of the closed form at theta, and plates must keep its rows straight. Otherwise each has the target
/// of a checkerboard of squares.
/// @param theta rad, in (-pi/2, pi/2), not 0
std::vector<TrialDrive> trial_drives(const Lattice& sheet, const ExactMotion& exact, double theta);

}  // namespace kinetix::model
