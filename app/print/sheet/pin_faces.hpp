#pragma once

#include "model/matter/process.hpp"
#include "model/solids/hinge_shape.hpp"

namespace kinetix::app {

/// How the knuckles of a pin stand over each other: flat a clearance apart, or where a process lays lines over gaps that
/// hold none of them, as FDM does, inclined but for a rim as wide as a line. Cones are that far apart that their layers,
/// which step sideways, keep the pin's clearance.
/// @param pin with its clearance   @return with axial_clearance_mm and rim_mm
model::HingePrint with_faces(model::HingePrint pin, const model::Process& process);

/// The least height of a pin whose eye, between two such clearances, is as high as they are. mm
double least_pin_height_mm(double clearance_mm, const model::Process& process);

}  // namespace kinetix::app
