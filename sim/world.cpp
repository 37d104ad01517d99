#include "sim/world.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

#include "sim/actuator.hpp"
#include "sim/direct_solver.hpp"
#include "sim/joints.hpp"
#include "sim/part_shape.hpp"
#include "sim/sweep_solver.hpp"

namespace kinetix {
namespace {

constexpr double part_mass = 1;
constexpr double touching = 1e-3;  // cell edges between parts that are said to touch

std::unique_ptr<btConstraintSolver> make_solver(const PhysicsOptions& options) {
  if (options.solver == PhysicsOptions::Solver::sweeps) return make_sweep_solver();
  return make_direct_solver(options.joint_stiffness);
}

void keep_in_plane(btRigidBody& body) {
  body.setLinearFactor({1, 1, 0});
  body.setAngularFactor({0, 0, 1});
}

btTransform at(double x, double y, double z) {
  return btTransform(btMatrix3x3::getIdentity(), btVector3(x, y, z));
}

Pose pose_of(const btTransform& transform, double edge_mm) {
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    pose.p[row] = edge_mm * transform.getOrigin()[row];
    for (int column = 0; column < 3; ++column) pose.R(row, column) = transform.getBasis()[row][column];
  }
  return pose;
}

}  // namespace

struct World::Parts {
  const Structure structure;
  const Drive drive;
  const PhysicsOptions options;

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  std::unique_ptr<btConstraintSolver> solver;
  btDiscreteDynamicsWorld world;

  std::vector<PartShape> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<Joint> joints;
  std::unique_ptr<Actuator> actuator;

  Parts(const Structure& s, const Drive& d, const PhysicsOptions& o)
      : structure(s),
        drive(d),
        options(o),
        solver(make_solver(o)),
        world(&dispatcher, &broadphase, solver.get(), &configuration) {
    world.setGravity({0, 0, 0});
    btContactSolverInfo& info = world.getSolverInfo();
    info.m_numIterations = options.iterations;
    info.m_splitImpulse = false;
    info.m_solverMode &= ~SOLVER_USE_WARMSTARTING;
    world.getSimulationIslandManager()->setSplitIslands(false);
    skip_walls_of_one_hinge();
    add_bodies();
    add_hinges();
    add_drive();
  }

  ~Parts() {
    while (world.getNumConstraints() > 0) world.removeConstraint(world.getConstraint(0));
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }

  void add_bodies() {
    const int group = options.contact ? 1 : 0;
    const auto walls = wall_prisms(structure, PartShape::margin);
    for (std::size_t b = 0; b < walls.size(); ++b) {
      const auto [i, j] = structure.bodies[b];
      const double inertia = options.part_inertia * part_mass;
      shapes.emplace_back(walls[b]);
      btRigidBody::btRigidBodyConstructionInfo info(part_mass, nullptr, shapes.back().get(),
                                                    {inertia, inertia, inertia});
      info.m_startWorldTransform = at(i, j, 0);
      info.m_friction = 0;
      bodies.push_back(std::make_unique<btRigidBody>(info));
      bodies.back()->setActivationState(DISABLE_DEACTIVATION);
      bodies.back()->setUserIndex(static_cast<int>(b));
      if (options.planar) keep_in_plane(*bodies.back());
      world.addRigidBody(bodies.back().get(), group, group);
    }
  }

  void add_hinges() {
    for (const Hinge& hinge : structure.hinges)
      for (Joint& point : hinge_points(hinge, *bodies[hinge.lower], *bodies[hinge.upper], options.reach,
                                       options.error_reduction))
        add(*joints.emplace_back(std::move(point)));
  }

  void add_drive() {
    actuator = make_actuator(structure, drive, bodies, options.error_reduction);
    for (auto* joint : actuator->joints()) add(*joint);
  }

  void add(btTypedConstraint& joint) {
    joint.setUserConstraintId(world.getNumConstraints());
    world.addConstraint(&joint);
  }
};

World::World(const Structure& structure, const Drive& drive, const PhysicsOptions& options)
    : parts_(std::make_unique<Parts>(structure, drive, options)) {}

World::~World() = default;

void World::push(double rate) {
  for (std::size_t b = 0; b < parts_->bodies.size(); ++b) {
    btRigidBody& body = *parts_->bodies[b];
    const int sense = parts_->structure.bodies[b].sense();
    body.setAngularVelocity(body.getAngularVelocity() + btVector3(0, 0, sense * rate));
  }
}

void World::start(const std::vector<Twist>& motion, double rate) {
  const auto vector = [&](const Eigen::Vector3d& v) {
    return btVector3(rate * v.x(), rate * v.y(), rate * v.z());
  };
  for (std::size_t b = 0; b < parts_->bodies.size(); ++b) {
    btRigidBody& body = *parts_->bodies[b];
    body.setAngularVelocity(body.getAngularVelocity() + body.getAngularFactor() * vector(motion[b].omega));
    body.setLinearVelocity(body.getLinearVelocity() + body.getLinearFactor() * vector(motion[b].v));
  }
}

void World::set_drive(double theta) { parts_->actuator->move_to(theta); }

void World::step() { parts_->world.stepSimulation(parts_->options.step_s, 0); }

void World::damp(double factor) {
  for (const auto& body : parts_->bodies) {
    body->setLinearVelocity(factor * body->getLinearVelocity());
    body->setAngularVelocity(factor * body->getAngularVelocity());
  }
}

State World::state() const {
  State state;
  state.reserve(parts_->bodies.size());
  for (const auto& body : parts_->bodies)
    state.push_back(pose_of(body->getWorldTransform(), parts_->structure.size.edge_mm));
  return state;
}

double World::fastest_part() const {
  double fastest = 0;
  for (const auto& body : parts_->bodies)
    for (const double speed : {body->getLinearVelocity().length(), body->getAngularVelocity().length()})
      if (!(speed <= fastest)) fastest = speed;
  return fastest;
}

double World::fastest_hinge() const {
  double fastest = 0;
  for (const Hinge& hinge : parts_->structure.hinges) {
    const auto& lower = *parts_->bodies[hinge.lower];
    const auto& upper = *parts_->bodies[hinge.upper];
    const double speed = (upper.getAngularVelocity() - lower.getAngularVelocity()).length();
    if (!(speed <= fastest)) fastest = speed;
  }
  return fastest;
}

double World::drive_gap() const { return parts_->actuator->gap(); }

PartContact World::deepest_contact() const {
  PartContact deepest{-1, -1, -touching};
  for (int m = 0; m < parts_->dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *parts_->dispatcher.getManifoldByIndexInternal(m);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const double depth = -manifold.getContactPoint(k).getDistance();
      if (depth > deepest.depth)
        deepest = {manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex(), depth};
    }
  }
  return deepest.touches() ? deepest : PartContact{};
}

double World::largest_middle_angle() const {
  double largest = 0;
  for (const Joint& joint : parts_->joints) largest = std::max(largest, std::abs(middle_euler_angle(*joint)));
  return largest;
}

}  // namespace kinetix
