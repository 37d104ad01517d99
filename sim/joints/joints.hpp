#pragma once

#include <array>
#include <memory>

#include "model/linkage/axis.hpp"
#include "model/linkage/linkage.hpp"

class btGeneric6DofSpring2Constraint;
class btTypedConstraint;
class btRigidBody;

namespace kinetix::sim {

using Joint = std::unique_ptr<btGeneric6DofSpring2Constraint>;

/// A hinge as one of its bodies carries it, in that body's frame; lengths in the unit of the engine's world
/// (cell edges in a compression run).
struct HingeFrame {
  Eigen::Vector3d point;
  Eigen::Vector3d axis;  ///< unit vector
  /// Unit vector, normal to the axis; of both bodies the same direction at the start.
  Eigen::Vector3d across;
};
using HingeFrames = std::array<HingeFrame, 2>;

/// Of the lower and the upper body of a hinge of a structure, cell edges.
HingeFrames hinge_frames(const model::RestHinge& hinge);

/// The two point constraints of a hinge, at the hinge point +- reach along the hinge axis: all linear axes
/// locked, all angular axes free. The first axis of the constraint frames lies along the hinge axis, so that
/// the fold is the Euler angle with the full range and the middle one (within a quarter turn) stays near 0.
/// @param reach in the unit of the hinge frames
/// @param error_reduction part of the gap removed per step, (0, 1], here and below
std::array<Joint, 2> hinge_points(const HingeFrames& hinge_frames, btRigidBody& a, btRigidBody& b,
                                  double reach, double error_reduction);

/// The one point constraint of a ball, as above.
Joint ball_point(const HingeFrames& hinge_frames, btRigidBody& a, btRigidBody& b, double error_reduction);

/// Locks the turn of the upper body against the lower one about their hinge axis; set_turn moves it.
Joint turn_lock(const model::RestHinge& hinge, btRigidBody& lower, btRigidBody& upper,
                double error_reduction);
/// @param angle rad, in (-pi, pi), counter-clockwise about the hinge axis
void set_turn(btGeneric6DofSpring2Constraint& joint, double angle);
/// Turn of the second body against the first about the first axis, rad, in [-pi, pi].
double turn(btGeneric6DofSpring2Constraint& joint);

/// A keyed pin cannot leave the plane z = 0 either.
enum class Pin { sliding, keyed };

/// Pin in a slot: keeps the origin of `body` in the plane normal to `axis` through the origin of `plate`,
/// free to slide in the plane (unless keyed) and to turn.
Joint slot(model::Axis axis, Pin pin, btRigidBody& plate, btRigidBody& body, double error_reduction);

/// A plate that pushes the origin of `body` along `inward`, away from itself, and does not pull it back. The engine
/// knows only joints that do both: it is for the direct solver to let go (is_one_sided).
Joint pusher(const Eigen::Vector3d& inward, btRigidBody& plate, btRigidBody& body, double error_reduction);
/// Whether a joint only pushes its second body along the first axis of its frame on the first one.
bool is_one_sided(const btTypedConstraint& joint);
/// Keeps the origin of `body` in the plane z = 0 of `plate`.
Joint height_lock(btRigidBody& plate, btRigidBody& body, double error_reduction);

/// Middle Euler angle of the joint's frames, rad, in [-pi/2, pi/2].
double middle_euler_angle(btGeneric6DofSpring2Constraint& joint);

}  // namespace kinetix::sim
