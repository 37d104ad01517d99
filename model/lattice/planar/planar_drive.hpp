#pragma once

#include "model/lattice/planar/planar_motion.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Drives of structures on planar graphs. Plates grip the bodies on the first and on the last line of vertices across
/// their axis: those with the least and the greatest rest position along it.

/// Returns the rows that plates grip. @throws InvalidInput if a row has a single body: it would let the panel turn
GrippedRows rim_rows(const PlanarStructure& structure, Axis axis);

/// Creates two plates that close by `compression`, in [0, 1). @param branch 1 or -1, the sign of theta
/// @throws InvalidInput as rim_rows, and for hinge parameters out of range
LinkageDrive plate_drive(const PlanarStructure& structure, Axis axis, double compression, int branch);
/// Creates a drive that turns the second body of a wall relative to the first one. @param angle rad, in (-pi, pi)
/// @throws InvalidInput for hinge parameters out of range
LinkageDrive hinge_drive(const PlanarStructure& structure, int hinge, double angle);
/// Returns plates along y, or else along x, whose lines stay straight in the exact motion and approach each other.
/// Otherwise, and without an exact motion, it returns the first upright hinge.
/// @param theta rad, in (-pi/2, pi/2). @throws InvalidInput for any other
LinkageDrive drive_to(const PlanarStructure& structure, double theta);

/// Returns true if rows of bodies that are straight across the axis at rest stay straight during the motion.
bool keeps_rows_straight(const Redrawing& y, Axis axis, const GrippedRows& rows);
/// Rejects plates whose rows do not stay straight. @throws InvalidInput
void refuse_rows_that_curve(const LinkageDrive& drive, const Redrawing& y);

}  // namespace kinetix::model
