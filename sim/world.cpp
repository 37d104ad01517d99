#include "sim/world.hpp"

#include <btBulletDynamicsCommon.h>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <new>
#include <set>

#include "sim/actuator.hpp"
#include "sim/joints/direct_solver.hpp"
#include "sim/joints/elastic_hinges.hpp"
#include "sim/joints/external_pulls.hpp"
#include "sim/joints/joints.hpp"
#include "sim/rigid_parts.hpp"
#include "sim/shapes/part_shape.hpp"

namespace kinetix::sim {
namespace {

// Stiffness of a point of an elastic hinge, times step^2 over the part mass. With less, soft modes take
// longer to settle. With more, unstable ones move further per step.
constexpr double elastic_stiffness = 1000;
constexpr double touching = 1e-3;  // cell edges between parts that are reported as touching

constexpr double longest_slide =
    5e-3;  // cell edges: how far a touching corner of sharp walls may move from where it was found

// Rad: a first-order motion may give any angle; springs rest below pi.
constexpr double largest_lean = 1.5;
// Stiffness of plates over that of the points of elastic hinges: yields 1e-4 of their gaps.
constexpr double elastic_grip = 1e4;

void* memory_or_throw(std::size_t bytes) {
  void* const memory = std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// Set before main: by default the engine does not check for failed allocations and writes to null.
[[maybe_unused]] const bool engine_throws = [] {
  btAlignedAllocSetCustom(memory_or_throw, std::free);
  return true;
}();

/// Returns the size of the engine's pools for pairs of near parts. By default it allocates and fills 8 MB,
/// which costs small scenes more than their run. Further pairs get separate memory.
btDefaultCollisionConstructionInfo memory_of_pairs(std::size_t parts) {
  constexpr int pairs_per_part = 8;  // walls of a cell and of the adjacent cells
  btDefaultCollisionConstructionInfo memory;
  memory.m_defaultMaxPersistentManifoldPoolSize = pairs_per_part * static_cast<int>(parts);
  memory.m_defaultMaxCollisionAlgorithmPoolSize = pairs_per_part * static_cast<int>(parts);
  return memory;
}

std::unique_ptr<btConstraintSolver> make_solver(const PhysicsOptions& options, double edge_mm,
                                                const ElasticHinges* elastic, const Cord* cord,
                                                const ExternalPulls& external_pulls, const double& max_motion,
                                                bool& agrees) {
  DirectSolverSettings settings{.joint_stiffness = options.joint_stiffness, .elastic = elastic, .cord = cord};
  settings.external_pulls = &external_pulls;
  settings.max_motion = &max_motion;
  settings.agrees = &agrees;
  settings.edge_mm = edge_mm;
  if (options.elastic) {
    settings.grip = elastic_grip;
    settings.contact_softness = 1 / options.elastic->contact;
  }
  return make_direct_solver(settings);
}

PhysicsOptions in_force(PhysicsOptions options) {
  if (!options.elastic) return options;
  options.reach = options.elastic->reach;
  options.joint_stiffness = elastic_stiffness;
  return options;
}

}  // namespace

struct World::Engine {
  const model::Linkage structure;
  const std::optional<model::LinkageDrive> drive;
  const PhysicsOptions options;
  /// Fraction of a gap removed per step. Gaps of elastic hinges pull as undamped springs do.
  const double error_reduction = options.elastic ? 1 : 0.95;

  btDefaultCollisionConfiguration configuration{memory_of_pairs(structure.bodies.size())};
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  std::optional<ElasticHinges> elastic;
  std::optional<Cord> cord;
  ExternalPulls external_pulls;
  double max_motion = std::numeric_limits<double>::infinity();
  bool agrees = true;  ///< whether the rows that pushed in the last step were consistent
  std::unique_ptr<btConstraintSolver> solver;
  btDiscreteDynamicsWorld world;

  RigidParts parts;
  std::vector<Joint> joints;
  std::unique_ptr<Actuator> actuator;
  std::vector<Vector6> speeds_before;   ///< the last step
  std::vector<TouchingPieces> passing;  ///< sorted

  Engine(const model::Linkage& s, const std::optional<model::LinkageDrive>& d, const PhysicsOptions& o,
         const ContactParts* contact_parts)
      : structure(s),
        drive(d),
        options(in_force(o)),
        elastic(make_elastic()),
        cord(make_cord()),
        external_pulls(options.joint_stiffness, structure.size.edge_mm),
        solver(make_solver(options, structure.size.edge_mm, elastic ? &*elastic : nullptr,
                           cord ? &*cord : nullptr, external_pulls, max_motion, agrees)),
        world(&dispatcher, &broadphase, solver.get(), &configuration),
        parts(structure, options, contact_parts) {
    world.setGravity({0, 0, 0});
    prepare_for_joints(world);
    if (options.elastic) world.getSolverInfo().m_erp2 = 1;
    world.getDispatchInfo().m_enableSatConvex = wall_surface(options) == WallSurface::sharp;
    skip_walls_of_one_hinge();
    add_bodies();
    if (contact_parts && options.contact) ignore_initial_contacts();
    add_hinges();
    if (drive) add_drive();
  }

  ~Engine() {
    while (world.getNumConstraints() > 0) world.removeConstraint(world.getConstraint(0));
    for (const auto& body : parts.bodies()) world.removeRigidBody(body.get());
  }

  std::optional<ElasticHinges> make_elastic() const {
    if (!options.elastic) return std::nullopt;
    return ElasticHinges(structure, *options.elastic);
  }

  std::optional<Cord> make_cord() const {
    if (!drive || !drive->only_pulls()) return std::nullopt;
    return Cord(structure, drive->through);
  }

  void add_bodies() {
    const int group = options.contact ? 1 : 0;
    for (const auto& body : parts.bodies()) world.addRigidBody(body.get(), group, group);
  }

  /// Finds all pieces of two bodies that touch the other body at rest. All pairs of them are listed, since
  /// different pairs meet as the bodies turn.
  void find_initial_contacts() {
    world.performDiscreteCollisionDetection();
    std::map<std::pair<int, int>, std::array<std::set<int>, 2>> touching;
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
      btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
      auto& pieces = touching[{manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex()}];
      for (int k = 0; k < manifold.getNumContacts(); ++k) {
        const btManifoldPoint& point = manifold.getContactPoint(k);
        if (!(point.getDistance() < touching_at_rest)) continue;
        pieces[0].insert(point.m_index0);
        pieces[1].insert(point.m_index1);
      }
      manifold.clearManifold();
    }
    for (const auto& [bodies, pieces] : touching)
      for (const int first : pieces[0])
        for (const int second : pieces[1])
          passing.push_back(in_order({bodies.first, first, bodies.second, second}));
    std::sort(passing.begin(), passing.end());
  }

  static TouchingPieces in_order(const TouchingPieces& p) {
    return p.body < p.other ? p : TouchingPieces{p.other, p.piece_of_other, p.body, p.piece};
  }

  void ignore_initial_contacts() {
    find_initial_contacts();
    for (const TouchingPieces& p : passing)
      PartShape::ignore_contact(*parts.bodies()[p.body], p.piece, *parts.bodies()[p.other], p.piece_of_other);
  }

  /// Adds the hinges. Points with stiffness in their hinge's frame are handled by the direct solver.
  void add_hinges() {
    const auto& bodies = parts.bodies();
    for (std::size_t h = 0; h < structure.hinges.size(); ++h) {
      const model::RestHinge& hinge = structure.hinges[h];
      const model::Stiffness* const k = options.elastic ? &options.elastic->of(h) : nullptr;
      if (k && k->framed()) continue;
      const HingeFrames frames = hinge_frames(hinge);
      btRigidBody &lower = *bodies[hinge.lower], &upper = *bodies[hinge.upper];
      if (hinge.ball) {
        add(ball_point(frames, lower, upper, error_reduction));
        continue;
      }
      for (Joint& point : hinge_points(frames, lower, upper, k ? k->reach : options.reach, error_reduction))
        add(std::move(point));
    }
  }

  void add(Joint joint) { world.addConstraint(joints.emplace_back(std::move(joint)).get()); }

  void add_drive() {
    actuator = make_actuator(structure, *drive, parts.bodies(), error_reduction,
                             elastic ? &*elastic : nullptr, options.spring_turn, cord ? &*cord : nullptr);
    for (auto* joint : actuator->joints()) world.addConstraint(joint);
  }

  void drop_points_that_slid() {
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m)
      dispatcher.getManifoldByIndexInternal(m)->setContactBreakingThreshold(longest_slide);
  }
};

World::World(const model::Linkage& structure, const std::optional<model::LinkageDrive>& drive,
             const PhysicsOptions& options, const ContactParts* parts)
    : engine_(std::make_unique<Engine>(structure, drive, options, parts)) {}

World::~World() = default;

ExternalPulls& World::external_pulls() { return engine_->external_pulls; }
void World::limit_motion(double longest) { engine_->max_motion = longest; }
RigidParts& World::parts() { return engine_->parts; }
const RigidParts& World::parts() const { return engine_->parts; }

void World::relax_along(const std::vector<model::Twist>& motion, double amount) {
  std::vector<double> angles;
  for (const model::RestHinge& hinge : engine_->structure.hinges) {
    const Eigen::Vector3d spin = motion[hinge.upper].omega - motion[hinge.lower].omega;
    const double turn = amount * spin.dot(hinge.axis);
    angles.push_back(std::clamp(turn, -largest_lean, largest_lean));
  }
  engine_->elastic->relax_at(angles);
}

void World::set_drive(double theta) { engine_->actuator->move_to(theta); }

void World::slow_to_cord() {
  if (!engine_->cord || engine_->elastic) return;
  const model::State state = engine_->parts.state();
  const Eigen::VectorXd pull = engine_->cord->pull(state);
  const std::vector<Vector6> speeds = engine_->parts.speeds();
  double shortens = 0;  // cell edges, in the next step
  for (std::size_t b = 0; b < speeds.size(); ++b)
    shortens += engine_->options.step_s * pull.segment<6>(6 * static_cast<Eigen::Index>(b)).dot(speeds[b]);
  const double asked = std::max(0.0, engine_->cord->excess(state));
  if (shortens > asked) engine_->parts.damp(asked / shortens);
}

void World::step() {
  engine_->speeds_before = engine_->parts.speeds();
  if (wall_surface(engine_->options) == WallSurface::sharp) engine_->drop_points_that_slid();
  engine_->world.stepSimulation(engine_->options.step_s, 0);
}

double World::free_force() const {
  return engine_->parts.largest_change(engine_->speeds_before) * engine_->options.step_s /
         engine_->options.joint_stiffness;
}

bool World::contacts_agree() const { return engine_->agrees; }

double World::drive_gap() const { return engine_->actuator->gap(); }

PartContact World::deepest_contact() const {
  PartContact deepest{-1, -1, -touching};
  for (int m = 0; m < engine_->dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *engine_->dispatcher.getManifoldByIndexInternal(m);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const double depth = -manifold.getContactPoint(k).getDistance();
      if (depth > deepest.depth)
        deepest = {manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex(), depth};
    }
  }
  return deepest.touches() ? deepest : PartContact{};
}

const std::vector<TouchingPieces>& World::touching_pieces() const { return engine_->passing; }

double World::largest_middle_angle() const {
  double largest = 0;
  for (const Joint& joint : engine_->joints)
    largest = std::max(largest, std::abs(middle_euler_angle(*joint)));
  return largest;
}

}  // namespace kinetix::sim
