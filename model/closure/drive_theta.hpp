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

/// theta, rad, of a motion where the drive has come to its own `theta`; nothing where it never does, and of springs, whose
/// hinges say how far they fold a sheet.
std::optional<double> folded_theta(const LinkageDrive& drive, double theta, const Linkage& linkage,
                                   const std::function<State(double)>& fold);

/// The drive's coordinate in any state, held by the drive or not. Plates: by the middles of their rows; springs: by mean_theta.
double coordinate_of(const LinkageDrive& drive, const Linkage& linkage, const State& state);
/// The coordinate that the load does work along, up to a constant. Plates: minus the distance of the first bodies that they grip, mm;
/// a cord: minus its length, mm; a hinge: its turn, rad. @pre not springs
double way_of(const LinkageDrive& drive, const Linkage& linkage, const State& state);
/// The LinkageDrive::theta(), rad, at which a drive would have a state as it is: of a hinge and a cord by their turn and
/// length, of plates and springs as mean_theta. Of a cord with the sign of the drive's own; 0 where it is slack.
double theta_in(const LinkageDrive& drive, const Linkage& linkage, const State& state);

/// Mean fold parameter, rad, of the upright hinges of a state (of all where none is upright): half their turns, in the
/// sense of the checkerboard.
double mean_theta(const Linkage& linkage, const State& state);

}  // namespace kinetix::model
