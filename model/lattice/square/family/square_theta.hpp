#pragma once

#include "model/lattice/square/family/classify.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// Returns the theta, rad, at which a sheet of an exact family reaches a drive's target.
/// @throws InvalidInput if there is no such theta, if rows between plates do not stay straight, and if a bending
/// sheet would roll between the plates
double theta_of(const LinkageDrive& drive, const Classification& kind, const Structure& structure);

}  // namespace kinetix::model
