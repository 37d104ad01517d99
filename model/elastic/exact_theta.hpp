#pragma once

#include "model/hinge/elasticity.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// Returns the theta, rad, to which a drive takes a structure along its closed form. For most drives it is
/// ExactMotion::theta_of(). Shape-memory springs fold a sheet only as far as its hinges allow. For them it is
/// the first minimum from flat of the energy of hinges and springs, to 1e-8 rad.
/// @pre driven.exact
/// @throws InvalidInput as ExactMotion::theta_of
double exact_theta(const DrivenLinkage& driven, const Elasticity& elasticity);

}  // namespace kinetix::model
