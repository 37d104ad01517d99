#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "model/base/algorithms.hpp"
#include "model/base/invalid_input.hpp"
#include "sim/joints/direct_solver.hpp"
#include "sim/joints/joints.hpp"
#include "tests/support/free_linkage_run.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;

btVector3 bullet(const Vector3d& v) { return btVector3(v.x(), v.y(), v.z()); }

btTransform bullet(const model::Pose& pose) {
  btMatrix3x3 basis;
  for (int row = 0; row < 3; ++row) basis[row].setValue(pose.R(row, 0), pose.R(row, 1), pose.R(row, 2));
  return btTransform(basis, bullet(pose.p));
}

/// @param shape unused, but the engine requires one for every body
std::unique_ptr<btRigidBody> make_body(const FreeLinkageBody& body, btCollisionShape& shape) {
  btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, &shape, bullet(body.inertia));
  info.m_startWorldTransform = bullet(body.pose);
  auto made = std::make_unique<btRigidBody>(info);
  made->setActivationState(DISABLE_DEACTIVATION);
  made->setLinearVelocity(bullet(body.motion.v));
  made->setAngularVelocity(bullet(body.motion.omega));
  return made;
}

sim::HingeFrame hinge_frame(const FreeLinkageHinge& hinge, const model::Pose& body) {
  const Eigen::Matrix3d back = body.R.transpose();
  return {back * (hinge.point - body.p), back * hinge.axis, back * hinge.axis.unitOrthogonal()};
}

void check(const char* field, double value, double above, double most) {
  if (!(value > above && value <= most))
    throw InvalidInput(fmt::format("{} is {}, must be above {} and at most {}", field, value, above, most));
}

/// A linkage in the engine.
class LinkageWorld {
 public:
  LinkageWorld(const FreeLinkage& linkage, const FreeLinkageOptions& options)
      : solver_(sim::make_direct_solver({.joint_stiffness = options.joint_stiffness, .grip = 1})),
        world_(&dispatcher_, &broadphase_, solver_.get(), &configuration_),
        ground_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, nullptr)) {
    sim::prepare_for_joints(world_);
    world_.setGravity(bullet(linkage.gravity));
    for (const FreeLinkageBody& body : linkage.bodies)
      world_.addRigidBody(bodies_.emplace_back(make_body(body, point_)).get(), 0, 0);
    for (const FreeLinkageHinge& hinge : linkage.hinges) add(linkage, hinge, options);
  }

  ~LinkageWorld() {
    while (world_.getNumConstraints() > 0) world_.removeConstraint(world_.getConstraint(0));
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void step(double step_s) { world_.stepSimulation(step_s, 0); }

  void read(std::vector<model::Pose>& poses, std::vector<model::Twist>& motion) const {
    poses.clear();
    motion.clear();
    for (const auto& body : bodies_) {
      poses.push_back(sim::pose_of(body->getWorldTransform(), 1));
      motion.push_back({sim::eigen(body->getAngularVelocity()), sim::eigen(body->getLinearVelocity())});
    }
  }

 private:
  void add(const FreeLinkage& linkage, const FreeLinkageHinge& hinge, const FreeLinkageOptions& options) {
    const auto pose = [&](int body) { return body < 0 ? model::Pose{} : linkage.bodies[body].pose; };
    const auto engine = [&](int body) -> btRigidBody& { return body < 0 ? ground_ : *bodies_[body]; };
    for (sim::Joint& point :
         sim::hinge_points({hinge_frame(hinge, pose(hinge.a)), hinge_frame(hinge, pose(hinge.b))},
                           engine(hinge.a), engine(hinge.b), options.reach, options.error_reduction))
      world_.addConstraint(joints_.emplace_back(std::move(point)).get());
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  std::unique_ptr<btConstraintSolver> solver_;
  btDiscreteDynamicsWorld world_;
  btSphereShape point_{1e-3};
  btRigidBody ground_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<sim::Joint> joints_;
};

double fastest(const std::vector<model::Twist>& motion) {
  double fastest = 0;
  for (const model::Twist& twist : motion)
    for (const double speed : {twist.v.norm(), twist.omega.norm()}) fastest = larger(fastest, speed);
  return fastest;
}

}  // namespace

void FreeLinkageOptions::validate() const {
  check("step_s", step_s, 0, 0.1);
  check("seconds", seconds, 0, 1000);
  check("joint_stiffness", joint_stiffness, 0, 1e12);
  check("error_reduction", error_reduction, 0, 1);
  check("reach", reach, 0, 10);
  check("speed_limit", speed_limit, 0, INFINITY);
}

FreeLinkageResult run_linkage(const FreeLinkage& linkage, const FreeLinkageOptions& options,
                              const FreeLinkageObserver& observer) {
  options.validate();
  linkage.validate();
  const auto begin = std::chrono::steady_clock::now();
  LinkageWorld world(linkage, options);
  FreeLinkageResult result;
  world.read(result.poses, result.motion);
  result.energy_start = linkage_energy(linkage, result.poses, result.motion);
  const int steps = static_cast<int>(std::ceil(options.seconds / options.step_s - 1e-9));
  while (result.steps < steps && result.status == FreeLinkageResult::Status::done) {
    world.step(options.step_s);
    ++result.steps;
    world.read(result.poses, result.motion);
    const FreeLinkageGap gap = linkage_gap(linkage, result.poses);
    result.gap = {std::max(result.gap.point, gap.point), std::max(result.gap.axis, gap.axis)};
    result.energy_end = linkage_energy(linkage, result.poses, result.motion);
    result.energy_drift = std::max(result.energy_drift, std::abs(result.energy_end - result.energy_start));
    if (!(fastest(result.motion) <= options.speed_limit)) result.status = FreeLinkageResult::Status::blew_up;
    if (observer) observer(result.steps * options.step_s, result.poses, result.motion);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace kinetix::testing
