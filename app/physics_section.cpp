#include "app/physics_section.hpp"

namespace kinetix {

PhysicsSection read_physics(const Node& root, double edge_mm) {
  PhysicsSection physics;
  const auto section = root.optional("physics");
  if (!section) return physics;
  section->reject_unknown_keys({"solver", "step_s", "iterations", "error_reduction", "reach_mm"});
  if (const auto node = section->optional("solver"))
    physics.solver = node->choice<PhysicsOptions::Solver>(
        {{"direct", PhysicsOptions::Solver::direct}, {"sweeps", PhysicsOptions::Solver::sweeps}});
  if (const auto node = section->optional("step_s"))
    physics.step_s = node->number({0, 0.1, false, true, "seconds"});
  if (const auto node = section->optional("iterations")) physics.iterations = node->integer(1, 100'000);
  if (const auto node = section->optional("error_reduction"))
    physics.error_reduction = node->number({0, 1, false, true});
  if (const auto node = section->optional("reach_mm"))
    physics.reach_mm = node->number(from_to(0.01 * edge_mm, 10 * edge_mm, "mm (0.01 to 10 cells)"));
  return physics;
}

}  // namespace kinetix
