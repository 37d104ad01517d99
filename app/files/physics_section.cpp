#include "app/files/physics_section.hpp"

#include <limits>

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Solver = sim::PhysicsOptions::Solver;

// What the key `solver` may say.
constexpr targets::Word<Solver> solvers[] = {{"direct", Solver::direct}, {"sweeps", Solver::sweeps}};

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
          {"solver", value::choice(solvers), targets::by_default("direct"),
           "how the joints of a step are solved: `direct`, all at once by a sparse factorisation, exact also "
           "for long chains and closed loops; `sweeps`, one after the other, `iterations` times, good to "
           "about "
           "20 columns, not with elastic hinges"},
          {"step_s", value::number({0, 0.1, false, true, "seconds"}),
           targets::otherwise(
               "0.01; 0.004, then 0.001 where that run does not settle where the model says; 0.001 "
               "alone where there is no model to compare with"),
           "time step"},
          {"iterations", value::integer(1, 100'000), targets::by_default(usual.iterations),
           "of `sweeps`, per step over all joints and contacts; `direct` has none"},
          {"error_reduction", value::number({0, 1, false, true}),
           targets::otherwise(targets::shortest_text(usual.error_reduction)),
           "part of a hinge's gap removed per step; not with elastic hinges, which follow their stiffnesses"},
          {"disturbance", value::number(targets::from_to(0, 1)), targets::by_default(usual.disturbance),
           "how far the first motion of every part is thrown off at random, over its spin: whether the run "
           "still ends where it should"},
          {"disturbance_seed", value::integer(0, std::numeric_limits<int>::max()), targets::by_default(0.0),
           "another number throws the parts another way"},
          {"reach_mm", value::length(targets::from_to(0.01, 10, "mm (0.01 to 10 cells)")),
           targets::otherwise("`hinge.reach_mm`, or that of a made hinge; else " +
                              targets::shortest_text(usual.reach) + " cells"),
           "half distance of the two points at which a hinge holds its bodies together"},
      },
      {}, "Section physics");
  return keys;
}

PhysicsSection read_physics(const targets::Section& root, double edge_mm) {
  PhysicsSection physics;
  const targets::Section section = root.section("physics");
  section.read("solver", physics.solver, solvers);
  section.read("step_s", physics.step_s);
  section.read("iterations", physics.iterations);
  section.read("error_reduction", physics.error_reduction);
  section.read("disturbance", physics.disturbance, targets::from_to(0, 1));
  section.read("disturbance_seed", physics.disturbance_seed);
  check_reach(root, section);
  section.read_length("reach_mm", physics.reach_mm, edge_mm);
  return physics;
}

void refuse_sweeps(const targets::Section& root, const PhysicsSection& physics) {
  if (physics.solver == Solver::sweeps)
    throw root.section("physics").optional("solver")->error(
        "`sweeps` handles only hinges that cannot stretch; allowed with elastic hinges: direct");
}

PhysicsSection read_elastic_physics(const targets::Section& root, double edge_mm) {
  const PhysicsSection physics = read_physics(root, edge_mm);
  refuse_sweeps(root, physics);
  if (physics.error_reduction)
    throw root.section("physics")
        .optional("error_reduction")
        ->key_error("is for hinges that cannot stretch; elastic ones follow hinge.k_point and hinge.k_turn");
  return physics;
}

}  // namespace kinetix::app
