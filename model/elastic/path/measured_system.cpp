#include "model/elastic/path/measured_system.hpp"

namespace kinetix::model {

Eigen::VectorXd path_direction(const ElasticSystem& system, const State& state, double theta,
                               double placed_at, const TangentStiffness& tangent, int refined) {
  Eigen::VectorXd pull = tangent.multiply_all(system.place_rate(placed_at));
  if (system.holds_coordinate())
    pull += -ElasticSystem::grip * system.driven_rate(placed_at) * system.driven_gradient(state);
  if (!system.drive().is_external())
    pull += system.drive().coordinate_rate(theta) * system.spring_gradient(state);
  const Eigen::VectorXd reduced = system.dofs().restrict(pull);
  Eigen::VectorXd along = tangent.solve(reduced);
  for (int k = 0; k < refined; ++k)
    along +=
        tangent.solve(reduced - system.dofs().restrict(tangent.multiply_all(system.dofs().extend(along))));
  return -system.dofs().extend(along);
}

namespace {

// Ratio of k_turn to k_point edge^2, half of that of the default hinge. At 1e-7, residual forces of states at
// rough tolerances before the goal appear as limit points of a sheet of 32 x 32 cells.
constexpr double soft_turning = 5e-7;

/// Returns the speed of the drive's coordinate along a direction: cell edges or rad, per rad of theta.
double drive_speed(const ElasticSystem& system, const State& state, double theta,
                   const Eigen::VectorXd& along) {
  if (!system.holds_coordinate())
    return system.drive().coordinate_rate(theta) * system.drive().travel(system.structure()) /
           system.structure().size.edge_mm;
  return system.driven_gradient(state).dot(along);
}

constexpr double difference = 2e-5;  // rad of theta: of central differences
// Iterations that refine the direction of a path. Its factor may be that of a state 2e-3 before, and each
// iteration leaves an error of about the square of that distance.
constexpr int refinements = 2;
// k_point edge or edge^2: for smaller loads, the residual of Newton's method would dominate a difference.
constexpr double min_load = 1e-7;

/// Returns the load of a state in equilibrium to first order, without the multiplier.
double load_of(const ElasticSystem& system, const State& state, double theta) {
  if (!system.holds_coordinate()) return system.load(state, theta);
  const Eigen::VectorXd by_drive = system.dofs().restrict(system.driven_gradient(state));
  return system.dofs().restrict(system.elastic_gradient(state)).dot(by_drive) / by_drive.squaredNorm();
}

}  // namespace

bool turns_softly(const ElasticSystem& system) { return system.stiffness().min_turn() < soft_turning; }

double load_along_path(const ElasticSystem& system, const State& state, double theta,
                       const TangentStiffness& tangent) {
  const Eigen::VectorXd along =
      system.place_rate(theta) + path_direction(system, state, theta, theta, tangent);
  return system.elastic_gradient(state).dot(along) / drive_speed(system, state, theta, along);
}

double load_stiffness(const ElasticSystem& system, const State& state, double theta,
                      const TangentStiffness& tangent) {
  const double rate = system.drive().coordinate_rate(theta);
  if (rate == 0 || !(std::abs(system.load(state, theta)) > min_load)) return NAN;
  const Eigen::VectorXd along =
      system.place_rate(theta) + path_direction(system, state, theta, theta, tangent, refinements);
  const auto load = [&](double by) { return load_of(system, system.retract(state, by * along), theta + by); };
  return (load(difference) - load(-difference)) / (2 * difference * rate);
}

double drive_load(const ElasticSystem& system, const State& state, double theta,
                  const TangentStiffness& tangent, bool stable) {
  const bool has_path = stable && theta != 0 && system.drive().is_external();
  return has_path && turns_softly(system) ? load_along_path(system, state, theta, tangent)
                                          : system.load(state, theta);
}

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
