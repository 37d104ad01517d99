#pragma once

#include "model/lattice/planar/planar_motion.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Drives of structures on planar graphs. Plates grip the bodies on the first and on the last line of vertices
/// across their axis: those whose place along it at rest is the least and the greatest.

/// @throws InvalidInput where one of these lines has a single body: it would let the panel turn
GrippedRows rim_rows(const PlanarStructure& structure, Axis axis);

/// Two plates that come closer by `compression`, in [0, 1). @param branch 1 or -1, the sign of theta
/// @throws InvalidInput as rim_rows, and for hinge parameters out of range
LinkageDrive plate_drive(const PlanarStructure& structure, Axis axis, double compression, int branch);
/// The second body of a wall turned against the first one. @param angle rad, in (-pi, pi)
/// @throws InvalidInput for hinge parameters out of range
LinkageDrive hinge_drive(const PlanarStructure& structure, int hinge, double angle);
/// Plates along y, else along x, whose lines stay straight in the exact motion and come closer; else, and
/// where there is no exact motion, the first hinge that stands upright.
/// @param theta rad, in (-pi/2, pi/2). @throws InvalidInput for any other
LinkageDrive drive_to(const PlanarStructure& structure, double theta);

/// Whether rows of bodies that are straight lines across the axis at rest stay so all along the motion.
bool keeps_rows_straight(const Redrawing& y, Axis axis, const GrippedRows& rows);
/// @throws InvalidInput for plates whose rows do not
void refuse_rows_that_curve(const LinkageDrive& drive, const Redrawing& y);

}  // namespace kinetix::model
