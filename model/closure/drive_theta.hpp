#pragma once

#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// theta, rad, within 90 deg on the drive's side of flat, at which a motion first has what the drive asks for:
/// the distance of the first bodies that the plates grip, or the turn of the driven hinge.
/// @param fold state at theta, rad   @throws InvalidInput where there is none
double theta_of(const LinkageDrive& drive, const Linkage& linkage, const std::function<State(double)>& fold);

}  // namespace kinetix::model
