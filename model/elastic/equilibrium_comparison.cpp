#include "model/elastic/equilibrium_comparison.hpp"

#include <sstream>

#include "model/elastic/newton.hpp"

namespace kinetix::model {
namespace {

using Outcome = EquilibriumComparison::Outcome;

/// Returns the stable equilibrium that minimisation from a state finds, if any.
std::optional<State> nearest_equilibrium(ElasticSystem& system, double theta, State state) {
  system.place(theta, state);
  TangentStiffness tangent(system.dofs());
  const NewtonResult found = minimise(system, theta, {}, state, tangent);
  if (!found.converged || !found.stable) return std::nullopt;
  return state;
}

std::string reason(const EquilibriumComparison& c) {
  std::ostringstream out;
  out.precision(2);
  out << "rms distance " << c.distance.rms << " cell edges";
  if (c.outcome == Outcome::agrees) return out.str();
  if (std::isnan(c.energy)) {
    out << ", and minimising the energy from the state finds no stable equilibrium";
    return out.str();
  }
  out << (c.outcome == Outcome::another_branch ? ": the state is on another branch, " : ": ")
      << c.from_equilibrium.rms << " from a stable equilibrium of ";
  out.precision(6);
  out << c.energy << " N mm; the model's has " << c.reference_energy << " N mm";
  return out.str();
}

}  // namespace

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::agrees:
      return "agrees";
    case Outcome::another_branch:
      return "another branch";
    case Outcome::disagrees:
      break;
  }
  return "disagrees";
}

EquilibriumComparison compare_equilibria(const EquilibriumScene& scene, const State& state,
                                         const State& reference, double tolerance) {
  const Linkage& s = scene.structure;
  ElasticSystem system(s, scene.elasticity, scene.drive, scene.planar, scene.contact);
  const double unit = energy_unit(scene.elasticity, s.size.edge_mm);
  EquilibriumComparison c;
  c.distance = aligned_distance(s, state, reference);
  c.reference_energy = unit * system.stored_energy(reference, scene.drive.theta());
  if (const auto equilibrium = nearest_equilibrium(system, scene.drive.theta(), state)) {
    c.from_equilibrium = aligned_distance(s, state, *equilibrium);
    c.energy = unit * system.stored_energy(*equilibrium, scene.drive.theta());
    const bool near = c.from_equilibrium.rms <= tolerance;
    const bool other = aligned_distance(s, *equilibrium, reference).rms > tolerance;
    if (near && other) c.outcome = Outcome::another_branch;
  }
  if (c.distance.rms <= tolerance) c.outcome = Outcome::agrees;
  c.why = reason(c);
  return c;
}

}  // namespace kinetix::model
