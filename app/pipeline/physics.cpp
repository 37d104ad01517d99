#include "app/pipeline/physics.hpp"

#include <fmt/format.h>

#include "model/assembly/assembly.hpp"
#include "model/lattice/planar/creased_motion.hpp"

namespace kinetix::app {
namespace {

constexpr double settle_residual_motion = 0.01;  // cell edges: half the default tolerance of a verification

}  // namespace

model::Elasticity elasticity_of(const HingeSection& hinge, const PhysicsSection& physics, double edge_mm) {
  if (!(hinge.k_turn > 0))
    throw InvalidInput("0 is out of range for elastic hinges. Give a number above 0, in N mm/rad",
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

constexpr double max_overlap_mm = 0.1;  // mm: convex pieces may project from their bodies by this much

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
  options.overlap_limit = std::max(options.overlap_limit, max_overlap_mm / bodies.edge_mm);
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

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double longest_step_s = 0.1;  // s, the most that PhysicsOptions::step_s allows
constexpr double stiff_joints = 1e8;    // over the parts' masses: ten thousand times that of usual joints
// Multiples of the usual step, tried one after the other. With the longest, most sheets settle in the same state, as
// near to the model's, in a tenth of the time.
constexpr std::array tried_steps = {10.0, 4.0, 1.0};

std::unique_lock<std::mutex> lock_engine(const RunOptions& options) {
  return options.engine ? std::unique_lock(*options.engine) : std::unique_lock<std::mutex>();
}

sim::PhysicsOptions with_steps(sim::PhysicsOptions options, double factor) {
  options.step_s *= factor;
  return options;
}

/// Stiffens the joints of a sheet that moves exactly. It never strains and may be long, and compliant joints let its
/// ends sway far behind.
sim::PhysicsOptions suited_to(const Run& run, sim::PhysicsOptions options) {
  const bool moves_exactly = run.closed_path ? run.closed_path->reached : static_cast<bool>(run.plan.exact);
  if (moves_exactly && !options.elastic) options.joint_stiffness = stiff_joints;
  return options;
}

sim::PhysicsResult run_engine(const Run& run, const PhysicsTask& task, const sim::PhysicsOptions& options,
                              const sim::PhysicsObserver& observer = {}) {
  if (task.pull) return run_pull(run.design.structure, *task.pull, options, *task.parts, observer);
  if (task.parts) return run_with_parts(run.design.structure, task.drive, options, *task.parts, observer);
  return run_compression(run.design.structure, task.drive, options, observer);
}

model::StateDistance distance(const model::Linkage& structure, const sim::PhysicsResult& physics,
                              const model::State& reference) {
  if (!std::isfinite(physics.gaps.max)) return {nan, nan};
  return aligned_distance(structure, physics.state, reference);
}

/// Compares the equilibria of simulation and model, since sheets of elastic hinges may have several.
std::optional<model::EquilibriumComparison> equilibria(const Run& run, const Verification& v,
                                                       const model::State& reference) {
  if (!is_settled(v) || !v.compared || !run.equilibrium) return std::nullopt;
  const Equilibrium& equilibrium = *run.equilibrium;
  return compare_equilibria(
      {run.design.structure, equilibrium.elasticity, equilibrium.drive, v.options.planar, v.options.contact},
      v.physics.state, reference, run.verify_tolerance);
}

Fidelity row_of(const Run& run, const std::string& model, const sim::PhysicsResult& physics,
                const model::State& reference) {
  const double rms = distance(run.design.structure, physics, reference).rms;
  return {model + " (" + to_string(physics.status) + ")", physics.seconds, rms,
          to_string(run.closed_path ? Model::exact : run.plan.model)};
}

/// Whether larger steps may be tried first. A model's state must show whether such a run reached the right end, and
/// no step may be requested. Imported bodies without a model's state count wherever they settle.
bool may_be_coarser(const Run& run, const PhysicsTask& task, const RunOptions& options) {
  return (run.closed_path || !task.reference.empty()) && !run.design.physics.step_s && !options.fidelity &&
         task.options.disturbance == 0;
}

Verification verified(const Run& run, const PhysicsTask& task, const sim::PhysicsOptions& physics,
                      const RunOptions& options) {
  Verification v;
  v.options = physics;
  sim::PhysicsObserver observer;
  observer.stop = options.stop;
  observer.progress = [&](double done) { options.progress("simulation", done); };
  v.physics = run_engine(run, task, v.options, observer);
  v.compared = !task.reference.empty();
  v.distance = is_settled(v) && v.compared ? distance(run.design.structure, v.physics, task.reference)
                                           : model::StateDistance{nan, nan};
  v.agrees = is_settled(v) && (!v.compared || v.distance.rms <= run.verify_tolerance);
  return v;
}

}  // namespace

bool is_settled(const Verification& verification) {
  return verification.physics.status == sim::PhysicsResult::Status::settled;
}

std::optional<Verification> verify(const Run& run, const PhysicsTask& task, const RunOptions& options,
                                   bool default_steps) {
  const auto alone = lock_engine(options);
  const sim::PhysicsOptions usual = suited_to(run, task.options);
  std::span<const double> steps = tried_steps;
  if (default_steps || !may_be_coarser(run, task, options)) steps = steps.last(1);
  Verification v;
  double seconds = 0;
  for (const double factor : steps) {
    v = verified(run, task, with_steps(usual, factor), options);
    v.coarse = factor > 1;
    seconds += v.physics.seconds;
    if (v.agrees || options.stop.stop_requested()) break;
  }
  v.physics.seconds = seconds;
  if (options.stop.stop_requested() && (!is_settled(v) || (v.coarse && !v.agrees))) return std::nullopt;
  v.equilibrium = equilibria(run, v, task.reference);
  return v;
}

std::vector<Fidelity> fidelity_of(const Run& run, const Verification& verification, const PhysicsTask& task,
                                  const RunOptions& options) {
  if (!verification.compared) return {};
  std::vector<Fidelity> rows = {row_of(run, "bullet", verification.physics, task.reference)};
  if (!options.fidelity) return rows;
  const auto alone = lock_engine(options);
  options.progress("speed against error", -1);
  for (const double factor : {4.0, 16.0}) {
    const sim::PhysicsOptions coarser = with_steps(verification.options, factor);
    if (coarser.step_s <= longest_step_s)
      rows.push_back(row_of(run, fmt::format("bullet, {} x step", factor), run_engine(run, task, coarser),
                            task.reference));
  }
  return rows;
}

}  // namespace kinetix::app
