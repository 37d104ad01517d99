#include "sim/rigid_parts.hpp"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "model/base/algorithms.hpp"
#include "sim/joints/joints.hpp"

namespace kinetix::sim {
namespace {

void keep_in_plane(btRigidBody& body) {
  body.setLinearFactor({1, 1, 0});
  body.setAngularFactor({0, 0, 1});
}

std::unique_ptr<btRigidBody> make_body(const Eigen::Vector3d& vertex, btCollisionShape* shape,
                                       double inertia) {
  btRigidBody::btRigidBodyConstructionInfo info(RigidParts::mass, nullptr, shape,
                                                {inertia, inertia, inertia});
  info.m_startWorldTransform =
      btTransform(btMatrix3x3::getIdentity(), btVector3(vertex.x(), vertex.y(), vertex.z()));
  info.m_friction = 0;
  auto body = std::make_unique<btRigidBody>(info);
  body->setActivationState(DISABLE_DEACTIVATION);
  return body;
}

}  // namespace

WallSurface wall_surface(const PhysicsOptions& options) {
  return options.elastic && options.planar ? WallSurface::sharp : WallSurface::rounded;
}

RigidParts::RigidParts(const model::Linkage& structure, const PhysicsOptions& options,
                       const ContactParts* parts)
    : structure_(structure), inertia_(options.part_inertia * mass) {
  if (parts)
    add_pieces(*parts, options);
  else
    add_walls(options);
}

void RigidParts::add_walls(const PhysicsOptions& options) {
  const WallSurface surface = wall_surface(options);
  for (const auto& walls : wall_prisms(structure_, PartShape::margin(surface)))
    add(PartShape(walls, surface), options);
}

void RigidParts::add_pieces(const ContactParts& parts, const PhysicsOptions& options) {
  int first = 0;
  for (auto pieces : parts.of_body) {
    for (auto& piece : pieces)
      for (Eigen::Vector3d& corner : piece) corner /= structure_.size.edge_mm;
    add(PartShape(pieces, first), options);
    first += static_cast<int>(pieces.size());
  }
}

void RigidParts::add(PartShape shape, const PhysicsOptions& options) {
  const std::size_t b = bodies_.size();
  shapes_.push_back(std::move(shape));
  bodies_.push_back(make_body(structure_.bodies[b].position, shapes_.back().get(), inertia_));
  bodies_.back()->setUserIndex(static_cast<int>(b));
  if (options.planar) keep_in_plane(*bodies_.back());
}

RigidParts::~RigidParts() = default;

void RigidParts::push(double rate) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Eigen::Vector3d spin = rate * structure_.bodies[b].first_turn();
    bodies_[b]->setAngularVelocity(bodies_[b]->getAngularVelocity() +
                                   btVector3(spin.x(), spin.y(), spin.z()));
  }
}

void RigidParts::start(const std::vector<model::Twist>& motion, double rate) {
  const auto vector = [&](const Eigen::Vector3d& v) {
    return btVector3(rate * v.x(), rate * v.y(), rate * v.z());
  };
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    btRigidBody& body = *bodies_[b];
    body.setAngularVelocity(body.getAngularVelocity() + body.getAngularFactor() * vector(motion[b].omega));
    body.setLinearVelocity(body.getLinearVelocity() + body.getLinearFactor() * vector(motion[b].v));
  }
}

void RigidParts::damp(double factor) {
  for (const auto& body : bodies_) {
    body->setLinearVelocity(factor * body->getLinearVelocity());
    body->setAngularVelocity(factor * body->getAngularVelocity());
  }
}

void RigidParts::place(const model::State& state) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const btTransform place = transform_of(state[b], structure_.size.edge_mm);
    bodies_[b]->setWorldTransform(place);
    bodies_[b]->setInterpolationWorldTransform(place);
    bodies_[b]->setLinearVelocity({0, 0, 0});
    bodies_[b]->setAngularVelocity({0, 0, 0});
  }
}

model::State RigidParts::state() const {
  model::State state;
  state.reserve(bodies_.size());
  for (const auto& body : bodies_)
    state.push_back(pose_of(body->getWorldTransform(), structure_.size.edge_mm));
  return state;
}

std::vector<Vector6> RigidParts::speeds() const {
  std::vector<Vector6> all;
  for (const auto& body : bodies_)
    (all.emplace_back() << eigen(body->getLinearVelocity()), eigen(body->getAngularVelocity())).finished();
  return all;
}

double RigidParts::fastest() const {
  double fastest = 0;
  for (const auto& body : bodies_)
    for (const double speed : {body->getLinearVelocity().length(), body->getAngularVelocity().length()})
      fastest = larger(fastest, speed);
  return fastest;
}

double RigidParts::fastest_hinge() const {
  double fastest = 0;
  for (const model::RestHinge& hinge : structure_.hinges) {
    const btVector3 turning =
        bodies_[hinge.upper]->getAngularVelocity() - bodies_[hinge.lower]->getAngularVelocity();
    fastest = larger(fastest, turning.length());
  }
  return fastest;
}

double RigidParts::kinetic_energy() const {
  double energy = 0;
  for (const Vector6& speed : speeds())
    energy += mass * speed.head<3>().squaredNorm() + inertia_ * speed.tail<3>().squaredNorm();
  return 0.5 * energy;
}

double RigidParts::largest_change(const std::vector<Vector6>& speeds_before) const {
  const std::vector<Vector6> now = speeds();
  double largest = 0;
  for (std::size_t b = 0; b < now.size(); ++b) {
    const Vector6 change = now[b] - speeds_before[b];
    const double momentum = larger(mass * change.head<3>().norm(), inertia_ * change.tail<3>().norm());
    largest = larger(largest, momentum);
  }
  return largest;
}

}  // namespace kinetix::sim
