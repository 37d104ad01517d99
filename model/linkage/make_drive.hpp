#pragma once

#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Creates plates that hold two rows of a whole linkage and approach each other.
/// @param compression 1 - distance / distance at rest, [0, 1)   @param branch 1 or -1, sign of theta
/// @param bodies number of bodies of the linkage
/// @throws InvalidInput for a compression or branch out of range
LinkageDrive plates_between(GrippedRows rows, Axis axis, double compression, int branch, int bodies);

/// Creates a drive that turns one hinge. @param sense of its lower body, 1 or -1   @param angle rad, in (-pi,
/// pi)
/// @throws InvalidInput for an angle out of range
LinkageDrive turned_hinge(int hinge, int sense, double angle);

}  // namespace kinetix::model
