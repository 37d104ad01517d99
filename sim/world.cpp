#include "sim/world.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/direct_solver.hpp"
#include "sim/joints.hpp"
#include "sim/part_shape.hpp"
#include "sim/sweep_solver.hpp"

namespace kinetix {
namespace {

constexpr double part_mass = 1;

int row_of(Vertex v, Axis axis) { return axis == Axis::x ? v.i : v.j; }

std::pair<int, int> first_and_last_row(const Structure& structure, Axis axis) {
  std::pair rows{std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
  for (const Vertex& v : structure.bodies) {
    rows.first = std::min(rows.first, row_of(v, axis));
    rows.second = std::max(rows.second, row_of(v, axis));
  }
  return rows;
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
  std::array<btRigidBody, 2> plates{btRigidBody(0, nullptr, nullptr), btRigidBody(0, nullptr, nullptr)};
  std::vector<Joint> joints;
  std::vector<int> rows;  ///< of the plates

  Parts(const Structure& s, const Drive& d, const PhysicsOptions& o)
      : structure(s),
        drive(d),
        options(o),
        solver(o.solver == PhysicsOptions::Solver::direct ? make_direct_solver() : make_sweep_solver()),
        world(&dispatcher, &broadphase, solver.get(), &configuration) {
    world.setGravity({0, 0, 0});
    world.getSolverInfo().m_numIterations = options.iterations;
    world.getSolverInfo().m_splitImpulse = false;
    world.getSolverInfo().m_solverMode &= ~SOLVER_USE_WARMSTARTING;
    add_bodies();
    add_hinges();
    add_drive();
  }

  ~Parts() {
    for (const Joint& joint : joints) world.removeConstraint(joint.get());
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }

  void add_bodies() {
    const int group = options.contact ? 1 : 0;
    const auto prisms = half_walls(structure, PartShape::margin);
    for (std::size_t b = 0; b < prisms.size(); ++b) {
      const auto [i, j] = structure.bodies[b];
      const double inertia = options.part_inertia * part_mass;
      shapes.emplace_back(prisms[b]);
      btRigidBody::btRigidBodyConstructionInfo info(part_mass, nullptr, shapes.back().get(),
                                                    {inertia, inertia, inertia});
      info.m_startWorldTransform = at(i, j, 0);
      info.m_friction = 0;
      bodies.push_back(std::make_unique<btRigidBody>(info));
      bodies.back()->setActivationState(DISABLE_DEACTIVATION);
      bodies.back()->setUserIndex(static_cast<int>(b));
      world.addRigidBody(bodies.back().get(), group, group);
    }
  }

  void add_hinges() {
    for (const Hinge& hinge : structure.hinges)
      for (Joint& point : hinge_points(hinge, *bodies[hinge.lower], *bodies[hinge.upper], options.reach,
                                       options.error_reduction))
        add(std::move(point));
  }

  void add_drive() {
    if (drive.kind == Drive::Kind::hinge) {
      const Hinge& hinge = structure.hinges[*structure.hinge_at(drive.wall)];
      add(hinge_turn(hinge, *bodies[hinge.lower], *bodies[hinge.upper], options.error_reduction));
      return;
    }
    const auto [first, last] = first_and_last_row(structure, drive.axis);
    rows = {first, last};
    for (int side = 0; side < 2; ++side) grip(side);
  }

  void grip(int side) {
    std::vector<int> rim;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (row_of(structure.bodies[b], drive.axis) == rows[side]) rim.push_back(static_cast<int>(b));
    const int middle = rim[rim.size() / 2];
    for (const int b : rim)
      add(slot(drive.axis, b == middle ? Pin::keyed : Pin::sliding, plates[side], *bodies[b],
               options.error_reduction));
  }

  void add(Joint joint) {
    joint->setUserConstraintId(static_cast<int>(joints.size()));
    world.addConstraint(joint.get(), true);
    joints.push_back(std::move(joint));
  }

  void move_plates(double theta) {
    const double middle = 0.5 * (rows[0] + rows[1]);
    for (int side = 0; side < 2; ++side) {
      const double place = middle + (rows[side] - middle) * std::cos(theta);
      plates[side].setWorldTransform(drive.axis == Axis::x ? at(place, 0, 0) : at(0, place, 0));
    }
  }
};

World::World(const Structure& structure, const Drive& drive, const PhysicsOptions& options)
    : parts_(std::make_unique<Parts>(structure, drive, options)) {}

World::~World() = default;

void World::start(double rate) {
  for (std::size_t b = 0; b < parts_->bodies.size(); ++b) {
    const double sign = parts_->structure.bodies[b].is_class_a() ? 1 : -1;
    parts_->bodies[b]->setAngularVelocity({0, 0, sign * rate});
  }
}

void World::set_drive(double theta) {
  if (parts_->drive.kind == Drive::Kind::plates) return parts_->move_plates(theta);
  set_turn(*parts_->joints.back(), parts_->drive.wall.from.is_class_a() ? -2 * theta : 2 * theta);
}

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

DeepestContact World::deepest_contact() const {
  DeepestContact deepest;
  for (int m = 0; m < parts_->dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *parts_->dispatcher.getManifoldByIndexInternal(m);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const double depth = -manifold.getContactPoint(k).getDistance();
      if (depth > deepest.depth)
        deepest = {manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex(), depth};
    }
  }
  return deepest;
}

}  // namespace kinetix
