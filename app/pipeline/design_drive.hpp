#pragma once

#include "app/files/design_file.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::app {

/// The drive of a design: as its file says, or to its theta. None of bodies that are pulled.
model::LinkageDrive drive_of(const Design& design);

/// Theta to which that takes a design along its closed form, rad: without a drive the design's own, to the last
/// bit; of springs by their stiffness and that of the hinges.
/// @pre exact
double exact_theta_of(const Design& design, const model::ExactMotion& exact);

}  // namespace kinetix::app
