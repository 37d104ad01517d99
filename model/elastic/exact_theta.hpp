#pragma once

#include "model/hinge/elasticity.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Theta, rad, to which a drive takes a structure along its closed form: as ExactMotion::theta_of has it; under springs of
/// shape memory, which fold a sheet as far as its hinges let them, that of the first minimum from flat of the energy of
/// hinges and springs, to 1e-8 rad.
/// @pre driven.exact
/// @throws InvalidInput as ExactMotion::theta_of
double exact_theta(const DrivenLinkage& driven, const Elasticity& elasticity);

}  // namespace kinetix::model
