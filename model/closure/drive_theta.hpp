#pragma once

#include "model/hinge/elasticity.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Returns the first theta, rad, at which a motion reaches the drive's target, within 89.9 deg of flat on the
/// drive's side. The target is the distance of the first gripped bodies (plates), the turn of the driven
/// hinge, or the length of the tendon (theta_of_cord). For springs the result is the theta at which they
/// rest.
/// @param fold state at theta, rad   @throws InvalidInput if there is no such theta
double theta_of(const LinkageDrive& drive, const Linkage& linkage, const std::function<State(double)>& fold);

/// Returns the theta, rad, within 89.9 deg of flat, at which a motion has the drive's tendon at its target
/// length. The nearer side of flat is used, and the drive's side if both are equally near. Empty if the
/// tendon never reaches it.
std::optional<double> theta_of_cord(const LinkageDrive& drive, const Linkage& linkage,
                                    const std::function<State(double)>& fold);

/// Returns the theta, rad, of a motion at which the drive reaches the value for its own `theta`. Empty if it
/// never does, and for springs, since hinges determine how far springs fold a sheet.
std::optional<double> folded_theta(const LinkageDrive& drive, double theta, const Linkage& linkage,
                                   const std::function<State(double)>& fold);

/// Returns the drive's coordinate in any state, prescribed by the drive or not. Plates use the mean positions
/// of their rows, springs use mean_theta.
double coordinate_of(const LinkageDrive& drive, const Linkage& linkage, const State& state);
/// Returns the coordinate along which the load does work, up to a constant. Plates: minus the distance of the
/// first bodies that they grip, mm. Tendon: minus its length, mm. Hinge: its turn, rad. @pre not springs
double work_coordinate(const LinkageDrive& drive, const Linkage& linkage, const State& state);
/// Returns the LinkageDrive::theta(), rad, that corresponds to a state. A hinge uses its turn and a tendon
/// its length, plates and springs use mean_theta. The sign for a tendon is that of the drive's branch; a
/// slack tendon gives 0.
double theta_in(const LinkageDrive& drive, const Linkage& linkage, const State& state);

/// Returns the mean fold parameter, rad, of the upright hinges of a state, or of all hinges if none is
/// upright: half their turns, signed by the checkerboard.
double mean_theta(const Linkage& linkage, const State& state);

/// Returns the theta, rad, to which a drive takes a structure along its closed form. For most drives it is
/// ExactMotion::theta_of(). Shape-memory springs fold a sheet only as far as its hinges allow. For them it is
/// the first minimum from flat of the energy of hinges and springs, to 1e-8 rad.
/// @pre driven.exact
/// @throws InvalidInput as ExactMotion::theta_of
double exact_theta(const DrivenLinkage& driven, const Elasticity& elasticity);

}  // namespace kinetix::model
