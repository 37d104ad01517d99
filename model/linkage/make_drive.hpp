#pragma once

#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Plates that hold two rows of a whole linkage and come nearer to each other.
/// @param compression 1 - their distance over that at rest, [0, 1)   @param branch 1 or -1, of theta's sign
/// @param bodies of the linkage
/// @throws InvalidInput for a compression or branch out of range
LinkageDrive plates_between(GrippedRows rows, Axis axis, double compression, int branch, int bodies);

/// One hinge that is turned. @param sense of its lower body, 1 or -1   @param angle rad, in (-pi, pi)
/// @throws InvalidInput for an angle out of range
LinkageDrive turned_hinge(int hinge, int sense, double angle);

}  // namespace kinetix::model
