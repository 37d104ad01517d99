#include "model/elastic/path/measured_system.hpp"

#include "model/elastic/path/drive_load.hpp"

namespace kinetix::model {

MeasuredSystem::MeasuredSystem(const Linkage& linkage, const Elasticity& elasticity,
                               const LinkageDrive& drive, const EquilibriumPathOptions& options)
    : planar(options.planar.value_or(all_vertical(linkage))),
      unit(energy_unit(elasticity, linkage.size.edge_mm)),
      elastic(linkage, elasticity, drive, planar, options.contact, options.bodies),
      tangent(elastic.dofs()) {}

EquilibriumStep MeasuredSystem::measured(const State& state, double theta, bool stable) const {
  const double load_unit = elastic.drive().has_force() ? unit / elastic.structure().size.edge_mm : unit;
  EquilibriumStep step;
  step.theta = theta;
  step.drive = elastic.drive().coordinate_at(theta);
  step.load = drive_load(elastic, state, theta, tangent, stable) * load_unit;
  if (stable) step.stiffness = load_stiffness(elastic, state, theta, tangent) * load_unit;
  step.energy = elastic.stored_energy(state, theta) * unit;
  step.springs = elastic.spring_energy(state, theta) * unit;
  step.gap = hinge_gaps(elastic.structure(), state).max;
  step.contacts = elastic.touching(state);
  step.stable = stable;
  return step;
}

std::vector<HingeEnergy> MeasuredSystem::hinge_energies(const State& state) const {
  std::vector<HingeEnergy> energies;
  for (std::size_t k = 0; k < elastic.hinges().size(); ++k) {
    const RestHinge& h = elastic.hinges()[k];
    const HingeEnergy e = hinge_energy(h, elastic.stiffness().of(k), state[h.lower], state[h.upper],
                                       elastic.structure().size.edge_mm);
    energies.push_back({e.stretch * unit, e.turn * unit});
  }
  return energies;
}

}  // namespace kinetix::model
