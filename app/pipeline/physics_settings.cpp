#include "app/pipeline/physics_settings.hpp"

#include <algorithm>

#include "model/assembly/assembly.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

constexpr double settle_residual_motion = 0.01;  // cell edges: half the default tolerance of a verification

}  // namespace

model::Elasticity elasticity_of(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm) {
  if (!(hinge.k_turn > 0))
    throw InvalidInput("0 is out of range for the elastic model; allowed: a number above 0, in N mm/rad",
                       {"", 0, 0, "hinge.k_turn"});
  const double reach = reach_mm(hinge, physics, edge_mm);
  const auto framed = framed_stiffness(hinge);
  model::Elasticity e = framed ? elasticity_of(*framed, reach)
                               : model::Elasticity{.k_point = hinge.k_point,
                                                   .k_turn = hinge.k_turn,
                                                   .reach_mm = reach,
                                                   .k_contact = 10 * hinge.k_point};
  if (hinge.made && hinge.made->with_play) e.play_mm = play_mm(*hinge.made);
  e.k_contact = hinge.k_contact.value_or(e.k_contact);
  return e;
}

double reach_mm(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm) {
  if (hinge.made) return model::reach_mm(*hinge.made);
  return hinge.reach_mm.value_or(physics_options(physics, edge_mm).reach * edge_mm);
}

sim::PhysicsOptions elastic_physics(const model::Elasticity& elasticity, const PhysicsSection& section,
                                    double edge_mm, bool planar, double k_spring) {
  sim::PhysicsOptions options = physics_options(section, edge_mm);
  options.elastic = relative(elasticity, edge_mm);
  options.reach = options.elastic->reach;
  options.planar = planar;
  options.settle_residual_motion = settle_residual_motion;
  options.spring_turn = k_spring / energy_unit(elasticity, edge_mm);
  return options;
}

sim::PhysicsOptions physics_options(const PhysicsSection& section, double edge_mm) {
  sim::PhysicsOptions options;
  options.step_s = section.step_s.value_or(options.step_s);
  options.disturbance = section.disturbance.value_or(options.disturbance);
  options.disturbance_seed = section.disturbance_seed.value_or(options.disturbance_seed);
  if (section.reach_mm) options.reach = *section.reach_mm / edge_mm;
  return options;
}

sim::PhysicsOptions rotary_physics(const HingeSection& hinge, const PhysicsSection& section, double edge_mm) {
  sim::PhysicsOptions options = physics_options(section, edge_mm);
  if (hinge.reach_mm || hinge.made) options.reach = reach_mm(hinge, section, edge_mm) / edge_mm;
  return options;
}

namespace {

constexpr double most_overlap_mm = 0.1;  // mm: convex pieces may project from their bodies by this much

/// Returns the stiffness of each hinge of imported bodies. The contact stiffness follows from the stiffest hinge.
model::Elasticity elasticity_of_bodies(const model::Assembly& bodies) {
  model::Elasticity whole;
  for (const model::AssemblyHinge& h : bodies.hinges) whole.each.push_back(elasticity_of(h.k, h.reach_mm));
  whole.k_point = whole.each.front().k_point;
  for (const model::Elasticity& e : whole.each) whole.k_point = std::max(whole.k_point, e.k_point);
  whole.k_contact = 10 * whole.k_point;
  return whole;
}

sim::PhysicsOptions physics_of_bodies(const Design& design) {
  const model::Assembly& bodies = *design.structure.assembly();
  sim::PhysicsOptions options;
  options.overlap_limit = std::max(options.overlap_limit, most_overlap_mm / bodies.edge_mm);
  options.reach = 1;
  for (const model::AssemblyHinge& h : bodies.hinges)
    options.reach = std::min(options.reach, h.reach_mm / bodies.edge_mm);
  options.planar = body_pull_of(design) && all_vertical(model::Linkage(design.structure));
  return options;
}

}  // namespace

model::Elasticity elasticity_of(const Design& design) {
  if (const model::Assembly* bodies = design.structure.assembly()) return elasticity_of_bodies(*bodies);
  const double edge_mm = design.structure.size().edge_mm;
  model::Elasticity whole = elasticity_of(design.hinge, design.physics, edge_mm);
  if (design.hinge_overrides.empty()) return whole;
  whole.each.assign(static_cast<std::size_t>(design.structure.hinges()), model::Elasticity(whole));
  for (const auto& [h, own] : design.hinge_overrides)
    whole.each[h] = elasticity_of(own, design.physics, edge_mm);
  whole.k_point = whole.each.front().k_point;  // the common `hinge` may apply to no hinge
  for (const model::Elasticity& hinge : whole.each) whole.k_point = std::max(whole.k_point, hinge.k_point);
  whole.k_contact = design.hinge.k_contact.value_or(10 * whole.k_point);
  return whole;
}

sim::PhysicsOptions physics_of(const Design& design, bool planar) {
  if (design.structure.assembly()) return physics_of_bodies(design);
  const double edge = design.structure.size().edge_mm;
  if (design.hinge.model == HingeSection::Model::elastic) {
    const double k_spring = design.drive ? spring_stiffness(*design.drive) : 0;
    return elastic_physics(elasticity_of(design), design.physics, edge, planar, k_spring);
  }
  return rotary_physics(design.hinge, design.physics, edge);
}

}  // namespace kinetix::app
