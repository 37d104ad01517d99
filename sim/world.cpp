#include "sim/world.hpp"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>

#include "sim/actuator.hpp"
#include "sim/bullet_math.hpp"
#include "sim/direct_solver.hpp"
#include "sim/elastic_hinges.hpp"
#include "sim/joints.hpp"
#include "sim/part_shape.hpp"
#include "sim/sweep_solver.hpp"

namespace kinetix {
namespace {

constexpr double part_mass = 1;
// Of a point of an elastic hinge, times step^2 over mass: less takes soft modes longer to settle, more takes
// unstable ones further in a step.
constexpr double elastic_stiffness = 1000;
constexpr double touching = 1e-3;  // cell edges between parts that are said to touch

constexpr double largest_lean = 1.5;  // rad
constexpr double elastic_grip = 1e4;  // of plates, over the points of elastic hinges

std::unique_ptr<btConstraintSolver> make_solver(const PhysicsOptions& options, double edge_mm,
                                                const ElasticHinges* elastic) {
  if (options.solver == PhysicsOptions::Solver::sweeps) return make_sweep_solver();
  DirectSolverSettings settings{.joint_stiffness = options.joint_stiffness, .elastic = elastic};
  if (options.elastic) {
    settings.grip = elastic_grip;
    settings.edge_mm = edge_mm;
    settings.contact_softness = 1 / options.elastic->contact;
  }
  return make_direct_solver(settings);
}

/// Gaps of elastic hinges pull as undamped springs do.
PhysicsOptions in_force(PhysicsOptions options) {
  if (!options.elastic) return options;
  options.reach = options.elastic->reach;
  options.error_reduction = 1;
  options.joint_stiffness = elastic_stiffness;
  return options;
}

void keep_in_plane(btRigidBody& body) {
  body.setLinearFactor({1, 1, 0});
  body.setAngularFactor({0, 0, 1});
}

btTransform at(double x, double y, double z) {
  return btTransform(btMatrix3x3::getIdentity(), btVector3(x, y, z));
}

}  // namespace

struct World::Parts {
  const Structure structure;
  const Drive drive;
  const PhysicsOptions options;

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  std::optional<ElasticHinges> elastic;
  std::unique_ptr<btConstraintSolver> solver;
  btDiscreteDynamicsWorld world;

  std::vector<PartShape> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<Joint> joints;
  std::unique_ptr<Actuator> actuator;
  std::vector<Vector6> speeds_before;  ///< the last step

  Parts(const Structure& s, const Drive& d, const PhysicsOptions& o)
      : structure(s),
        drive(d),
        options(in_force(o)),
        elastic(make_elastic()),
        solver(make_solver(options, structure.size.edge_mm, elastic ? &*elastic : nullptr)),
        world(&dispatcher, &broadphase, solver.get(), &configuration) {
    world.setGravity({0, 0, 0});
    btContactSolverInfo& info = world.getSolverInfo();
    info.m_numIterations = options.iterations;
    info.m_splitImpulse = false;
    if (options.elastic) info.m_erp2 = 1;
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

  std::optional<ElasticHinges> make_elastic() const {
    if (!options.elastic) return std::nullopt;
    return ElasticHinges(structure, *options.elastic);
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
    actuator =
        make_actuator(structure, drive, bodies, options.error_reduction, elastic ? &*elastic : nullptr);
    for (auto* joint : actuator->joints()) add(*joint);
  }

  void add(btTypedConstraint& joint) {
    joint.setUserConstraintId(world.getNumConstraints());
    world.addConstraint(&joint);
  }

  std::vector<Vector6> speeds() const {
    std::vector<Vector6> all;
    for (const auto& body : bodies)
      (all.emplace_back() << eigen(body->getLinearVelocity()), eigen(body->getAngularVelocity())).finished();
    return all;
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

void World::relax_along(const std::vector<Twist>& motion, double amount) {
  std::vector<double> angles;
  for (const Hinge& hinge : parts_->structure.hinges) {
    const Eigen::Vector3d spin = motion[hinge.upper].omega - motion[hinge.lower].omega;
    const double turn = amount * spin.dot(hinge_axis(hinge.wall.axis, hinge.parameters));
    angles.push_back(std::clamp(turn, -largest_lean, largest_lean));
  }
  parts_->elastic->relax_at(angles);
}

void World::set_drive(double theta) { parts_->actuator->move_to(theta); }

void World::step() {
  parts_->speeds_before = parts_->speeds();
  parts_->world.stepSimulation(parts_->options.step_s, 0);
}

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

double World::kinetic_energy() const {
  double energy = 0;
  for (const Vector6& speed : parts_->speeds())
    energy += speed.head<3>().squaredNorm() + parts_->options.part_inertia * speed.tail<3>().squaredNorm();
  return 0.5 * part_mass * energy;
}

double World::free_force() const {
  const std::vector<Vector6> now = parts_->speeds();
  double largest = 0;
  for (std::size_t b = 0; b < now.size(); ++b) {
    const Vector6 change = now[b] - parts_->speeds_before[b];
    const double force =
        std::max(change.head<3>().norm(), parts_->options.part_inertia * change.tail<3>().norm());
    if (!(force <= largest)) largest = force;
  }
  return part_mass * largest * parts_->options.step_s / parts_->options.joint_stiffness;
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
