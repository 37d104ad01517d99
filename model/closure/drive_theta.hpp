#pragma once

#include <optional>

#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// theta, rad, within 90 deg on the drive's side of flat, at which a motion first has what the drive asks for:
/// the distance of the first bodies that the plates grip, the turn of the driven hinge, or the length of the cord
/// (theta_of_cord). Springs alone take a sheet to the theta at which they rest.
/// @param fold state at theta, rad   @throws InvalidInput where there is none
double theta_of(const LinkageDrive& drive, const Linkage& linkage, const std::function<State(double)>& fold);

/// theta, rad, within 89.9 deg of flat, at which a motion has the cord of a drive as short as is asked: on the side of flat
/// where that is nearer, on the drive's where both are as near. Nothing where it never is.
std::optional<double> theta_of_cord(const LinkageDrive& drive, const Linkage& linkage,
                                    const std::function<State(double)>& fold);

/// Mean fold parameter, rad, of the upright hinges of a state (of all where none is upright): half their turns, in the
/// sense of the checkerboard.
double mean_theta(const Linkage& linkage, const State& state);

}  // namespace kinetix::model
