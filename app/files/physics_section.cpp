#include "app/files/physics_section.hpp"

#include <limits>

#include "targets/document/bound_key.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr const char* only_solver = "direct";

void check_solver(const targets::Section& physics) {
  const auto solver = physics.optional("solver");
  if (!solver) return;
  if (solver->text(only_solver) == "sweeps")
    throw solver->error("`sweeps` was removed. Give `direct`, which replaces it, or remove the key");
  solver->one_of({only_solver});
}

void check_reach(const targets::Section& root, const targets::Section& physics) {
  const auto hinge = root.node().optional("hinge");
  if (!physics.optional("reach_mm") || !hinge) return;
  for (const char* key : {"reach_mm", "kind"})
    if (hinge->optional(key))
      throw physics.optional("reach_mm")
          ->key_error("and hinge." + std::string(key) + " say the same thing; give one of them");
}

}  // namespace

const targets::KeyTable& physics_keys() {
  static const sim::PhysicsOptions usual{};
  static const targets::KeyTable keys(
      {
          {"solver", value::choice({only_solver}), targets::by_default(only_solver),
           "how the joints of a step are solved: all at once, by a sparse factorisation, which is exact also "
           "for long chains and closed loops"},
          {"step_s", &PhysicsSection::step_s, value::number({0, 0.1, false, true, "seconds"}),
           targets::otherwise(
               "0.01; 0.004, then 0.001 where that run does not settle where the model says; 0.001 "
               "alone where there is no model to compare with"),
           "time step"},
          {"disturbance", &PhysicsSection::disturbance, value::number(targets::from_to(0, 1)),
           targets::by_default(usual.disturbance),
           "how far the first motion of every part is thrown off at random, over its spin: whether the run "
           "still ends where it should"},
          {"disturbance_seed", &PhysicsSection::disturbance_seed,
           value::integer(0, std::numeric_limits<int>::max()), targets::by_default(0.0),
           "another number throws the parts another way"},
          {"reach_mm", &PhysicsSection::reach_mm,
           value::length(targets::from_to(0.01, 10, "mm (0.01 to 10 cells)")),
           targets::otherwise("`hinge.reach_mm`, or that of a made hinge; else " +
                              targets::shortest_text(usual.reach) + " cells"),
           "half distance of the two points at which a hinge holds its bodies together"},
      },
      {}, "Section physics",
      {
          {"iterations",
           "was removed: the solver has no iterations. Remove the key, or give a smaller `step_s`"},
          {"error_reduction",
           "was removed: each step closes 0.95 of the gap of a rigid hinge. Remove the key"},
      });
  return keys;
}

PhysicsSection read_physics(const targets::Section& root, double edge_mm) {
  PhysicsSection physics;
  const targets::Section section = root.section("physics");
  check_solver(section);
  check_reach(root, section);
  section.read_into(physics, edge_mm);
  return physics;
}

}  // namespace kinetix::app
