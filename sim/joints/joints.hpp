#pragma once

#include <memory>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

class btMatrix3x3;
class btTransform;
class btVector3;

namespace kinetix::sim {

Eigen::Vector3d eigen(const btVector3& v);
Eigen::Matrix3d eigen(const btMatrix3x3& m);
/// Converts a pose. @param transform in cell edges   @return in mm
model::Pose pose_of(const btTransform& transform, double edge_mm);
/// Converts a pose in mm to a transform in cell edges.
btTransform transform_of(const model::Pose& mm, double edge_mm);

}  // namespace kinetix::sim

class btGeneric6DofSpring2Constraint;
class btTypedConstraint;
class btRigidBody;

namespace kinetix::sim {

using Joint = std::unique_ptr<btGeneric6DofSpring2Constraint>;

/// Hinge in the frame of one of its bodies; lengths in the unit of the engine's world (cell edges in a
/// compression run).
struct HingeFrame {
  Eigen::Vector3d point;
  Eigen::Vector3d axis;  ///< unit vector
  /// Unit vector, normal to the axis; the same direction for both bodies at the start.
  Eigen::Vector3d across;
};
using HingeFrames = std::array<HingeFrame, 2>;

/// Returns the frames of a hinge in its lower and its upper body, cell edges.
HingeFrames hinge_frames(const model::RestHinge& hinge);

/// Returns the two point constraints of a hinge, at the hinge point +- reach along the hinge axis: all linear
/// axes locked, all angular axes free. The first axis of the constraint frames is along the hinge axis. The
/// fold is then the Euler angle with the full range, and the middle one (within a quarter turn) stays near 0.
/// @param reach in the unit of the hinge frames.
/// @param error_reduction fraction of the gap removed per step, (0, 1], here and below
std::array<Joint, 2> hinge_points(const HingeFrames& hinge_frames, btRigidBody& a, btRigidBody& b,
                                  double reach, double error_reduction);

/// Returns the one point constraint of a ball joint.
Joint ball_point(const HingeFrames& hinge_frames, btRigidBody& a, btRigidBody& b, double error_reduction);

/// Locks the relative turn of the two bodies about their hinge axis; set_turn changes it.
Joint turn_lock(const model::RestHinge& hinge, btRigidBody& lower, btRigidBody& upper,
                double error_reduction);
/// Sets the turn of a turn_lock. @param angle rad, in (-pi, pi), counter-clockwise about the hinge axis
void set_turn(btGeneric6DofSpring2Constraint& joint, double angle);
/// Returns the turn of the second body relative to the first about the first axis, rad, in [-pi, pi].
double turn(btGeneric6DofSpring2Constraint& joint);

/// Kind of a pin in a slot. A keyed pin stays in the plane z = 0, too.
enum class Pin { sliding, keyed };

/// Makes a pin in a slot. It keeps the origin of `body` in the plane normal to `axis` through the origin of
/// `plate`. The body may slide in the plane (unless keyed) and turn.
Joint slot(model::Axis axis, Pin pin, btRigidBody& plate, btRigidBody& body, double error_reduction);

/// Makes a plate that pushes the origin of `body` along `inward`, away from itself, and does not pull it
/// back. The engine has only two-sided joints, so the direct solver releases it (is_one_sided).
Joint pusher(const Eigen::Vector3d& inward, btRigidBody& plate, btRigidBody& body, double error_reduction);
/// Returns whether a joint only pushes its second body along the first axis of its frame on the first one.
bool is_one_sided(const btTypedConstraint& joint);
/// Keeps the origin of `body` in the plane z = 0 of `plate`.
Joint height_lock(btRigidBody& plate, btRigidBody& body, double error_reduction);

/// Returns the middle Euler angle of the joint's frames, rad, in [-pi/2, pi/2].
double middle_euler_angle(btGeneric6DofSpring2Constraint& joint);

}  // namespace kinetix::sim
