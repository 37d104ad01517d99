#pragma once

#include "model/lattice/square/family/classify.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::model {

/// theta, rad, at which a sheet of an exact family has what a drive asks for.
/// @throws InvalidInput for a theta that there is not, plates that hold rows straight which curve, and plates
/// between which a bending sheet would roll
double theta_of(const LinkageDrive& drive, const Classification& kind, const Structure& structure);

}  // namespace kinetix::model
