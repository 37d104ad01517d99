#pragma once

#include "model/closure/closure_drive.hpp"
#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::optim {

/// The hinge by which a panel is best turned as a whole: in its middle half, both across and up, where the way to
/// every other hinge is short, the one with the least offset, whose wall is scaled least; of several the nearest to
/// the middle. Where the middle half holds none, as in a strip, the nearest to the middle.
int middle_hinge(const model::PlanarStructure& panel, const model::Redrawing& y);

/// How far that hinge turns where the panel comes to theta, rad.
model::HingeTurn turn_to(const model::PlanarStructure& panel, int hinge, double theta);

}  // namespace kinetix::optim
