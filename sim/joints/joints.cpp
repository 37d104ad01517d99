#include "sim/joints/joints.hpp"

#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <LinearMath/btTransform.h>
#include <Eigen/Geometry>

namespace kinetix::sim {

Eigen::Vector3d eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Matrix3d eigen(const btMatrix3x3& m) {
  Eigen::Matrix3d out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) out(row, column) = m[row][column];
  return out;
}

model::Pose pose_of(const btTransform& transform, double edge_mm) {
  return {eigen(transform.getBasis()), edge_mm * eigen(transform.getOrigin())};
}

btTransform transform_of(const model::Pose& mm, double edge_mm) {
  const auto& R = mm.R;
  const Eigen::Vector3d p = mm.p / edge_mm;
  return btTransform(
      btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      btVector3(p.x(), p.y(), p.z()));
}

namespace {

// Numbers of the engine's axes: three linear ones, then three angular ones.
constexpr int linear_x = 0, linear_y = 1, angular_x = 3;
// Mark on a one-sided constraint, which the engine ignores; no other constraint here has one.
constexpr int one_sided = 1;

btVector3 in_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

btTransform frame(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                  const Eigen::Vector3d& origin) {
  const Eigen::Vector3d third = first.cross(second);
  btMatrix3x3 basis;
  for (int row = 0; row < 3; ++row) basis[row].setValue(first[row], second[row], third[row]);
  return btTransform(basis, in_bullet(origin));
}

Joint free_joint(btRigidBody& a, btRigidBody& b, const btTransform& in_a, const btTransform& in_b) {
  auto joint = std::make_unique<btGeneric6DofSpring2Constraint>(a, b, in_a, in_b, RO_XYZ);
  for (int axis = 0; axis < 6; ++axis) joint->setLimit(axis, 1, -1);
  return joint;
}

void lock(btGeneric6DofSpring2Constraint& joint, int axis, double error_reduction) {
  joint.setLimit(axis, 0, 0);
  joint.setParam(BT_CONSTRAINT_STOP_ERP, error_reduction, axis);
}

/// Returns the frame at the hinge point in one body, moved along the axis.
btTransform frame(const HingeFrame& hinge_frame, double along_axis) {
  return frame(hinge_frame.axis, hinge_frame.across, hinge_frame.point + along_axis * hinge_frame.axis);
}

Joint point_on_axis(const HingeFrames& hinge_frames, btRigidBody& a, btRigidBody& b, double along_axis,
                    double error_reduction) {
  Joint point = free_joint(a, b, frame(hinge_frames[0], along_axis), frame(hinge_frames[1], along_axis));
  for (int axis = 0; axis < 3; ++axis) lock(*point, axis, error_reduction);
  return point;
}

}  // namespace

HingeFrames hinge_frames(const model::RestHinge& hinge) {
  const Eigen::Vector3d across = hinge.axis.unitOrthogonal();
  return {HingeFrame{hinge.lower_arm, hinge.axis, across}, HingeFrame{hinge.upper_arm, hinge.axis, across}};
}

std::array<Joint, 2> hinge_points(const HingeFrames& hinge_frames, btRigidBody& a, btRigidBody& b,
                                  double reach, double error_reduction) {
  return {point_on_axis(hinge_frames, a, b, -reach, error_reduction),
          point_on_axis(hinge_frames, a, b, reach, error_reduction)};
}

Joint ball_point(const HingeFrames& hinge_frames, btRigidBody& a, btRigidBody& b, double error_reduction) {
  return point_on_axis(hinge_frames, a, b, 0, error_reduction);
}

Joint turn_lock(const model::RestHinge& hinge, btRigidBody& lower, btRigidBody& upper,
                double error_reduction) {
  const auto [of_lower, of_upper] = hinge_frames(hinge);
  Joint joint = free_joint(lower, upper, frame(of_lower, 0), frame(of_upper, 0));
  lock(*joint, angular_x, error_reduction);
  return joint;
}

// The engine counts the angles of this constraint clockwise.
void set_turn(btGeneric6DofSpring2Constraint& joint, double angle) {
  joint.setLimit(angular_x, -angle, -angle);
}

double turn(btGeneric6DofSpring2Constraint& joint) {
  joint.calculateTransforms();
  return -joint.getAngle(0);
}

Joint slot(model::Axis axis, Pin pin, btRigidBody& plate, btRigidBody& body, double error_reduction) {
  const btTransform here = frame(edge_direction(axis), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  Joint joint = free_joint(plate, body, here, here);
  lock(*joint, linear_x, error_reduction);
  if (pin == Pin::keyed) lock(*joint, linear_y, error_reduction);
  return joint;
}

Joint pusher(const Eigen::Vector3d& inward, btRigidBody& plate, btRigidBody& body, double error_reduction) {
  const btTransform here = frame(inward, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  Joint joint = free_joint(plate, body, here, here);
  lock(*joint, linear_x, error_reduction);
  joint->setUserConstraintType(one_sided);
  return joint;
}

bool is_one_sided(const btTypedConstraint& joint) { return joint.getUserConstraintType() == one_sided; }

Joint height_lock(btRigidBody& plate, btRigidBody& body, double error_reduction) {
  const btTransform here = frame(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero());
  Joint joint = free_joint(plate, body, here, here);
  lock(*joint, linear_x, error_reduction);
  return joint;
}

double middle_euler_angle(btGeneric6DofSpring2Constraint& joint) {
  joint.calculateTransforms();
  return joint.getAngle(1);
}

}  // namespace kinetix::sim
