#pragma once

#include "model/closure/closure_drive.hpp"
#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::optim {

/// Returns the hinge by which a panel is best turned as a whole. In the middle half, across and up, the path
/// to every other hinge is short. Of its hinges the one with the least offset is chosen, whose wall scales
/// least; ties go to the nearest to the middle. A strip has no hinge in its middle half: then the nearest to
/// the middle is chosen.
int middle_hinge(const model::PlanarStructure& panel, const model::Redrawing& y);

/// Returns the turn of that hinge at which the panel reaches theta, rad.
model::HingeTurn turn_to(const model::PlanarStructure& panel, int hinge, double theta);

}  // namespace kinetix::optim
