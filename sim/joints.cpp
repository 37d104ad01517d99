#include "sim/joints.hpp"

#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <Eigen/Geometry>

namespace kinetix {
namespace {

constexpr int linear_x = 0, linear_y = 1, angular_x = 3;

btVector3 bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

btTransform frame(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                  const Eigen::Vector3d& origin) {
  const Eigen::Vector3d third = first.cross(second);
  btMatrix3x3 basis;
  for (int row = 0; row < 3; ++row) basis[row].setValue(first[row], second[row], third[row]);
  return btTransform(basis, bullet(origin));
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

/// The hinge point as seen from its two bodies, moved along the axis.
std::array<btTransform, 2> hinge_frames(const Hinge& hinge, double along_axis) {
  const Eigen::Vector3d axis = hinge_axis(hinge.wall.axis, hinge.parameters);
  const Eigen::Vector3d edge = edge_direction(hinge.wall.axis);
  const double t = hinge.parameters.t;
  const Eigen::Vector3d second = axis.unitOrthogonal(), shift = along_axis * axis;
  return {frame(axis, second, t * edge + shift), frame(axis, second, (t - 1) * edge + shift)};
}

}  // namespace

std::array<Joint, 2> hinge_points(const Hinge& hinge, btRigidBody& lower, btRigidBody& upper, double reach,
                                  double error_reduction) {
  std::array<Joint, 2> points;
  for (int k = 0; k < 2; ++k) {
    const auto [in_lower, in_upper] = hinge_frames(hinge, k == 0 ? -reach : reach);
    points[k] = free_joint(lower, upper, in_lower, in_upper);
    for (int axis = 0; axis < 3; ++axis) lock(*points[k], axis, error_reduction);
  }
  return points;
}

Joint turn_lock(const Hinge& hinge, btRigidBody& lower, btRigidBody& upper, double error_reduction) {
  const auto [in_lower, in_upper] = hinge_frames(hinge, 0);
  Joint joint = free_joint(lower, upper, in_lower, in_upper);
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

Joint slot(Axis axis, Pin pin, btRigidBody& plate, btRigidBody& body, double error_reduction) {
  const btTransform here = frame(edge_direction(axis), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero());
  Joint joint = free_joint(plate, body, here, here);
  lock(*joint, linear_x, error_reduction);
  if (pin == Pin::keyed) lock(*joint, linear_y, error_reduction);
  return joint;
}

double middle_euler_angle(btGeneric6DofSpring2Constraint& joint) {
  joint.calculateTransforms();
  return joint.getAngle(1);
}

}  // namespace kinetix
