#include "python/bindings/sensitivities.hpp"

#include <fmt/format.h>

namespace kinetix::python {
namespace {

namespace py = pybind11;

const app::Equilibrium& reached_equilibrium(const app::Run& run) {
  if (!run.equilibrium) throw InvalidInput("there is no equilibrium: simulate with model=\"equilibrium\"");
  if (!run.equilibrium->reached())
    throw InvalidInput("the equilibrium did not reach its drive's goal: " + run.equilibrium->path.why);
  return *run.equilibrium;
}

/// Converts derivatives by poses to the order and unit of the adjoint: turns first, shifts in cell edges.
Eigen::VectorXd by_state(const Numbers& poses, int bodies, double edge_mm) {
  if (poses.ndim() != 2 || poses.shape(0) != bodies || poses.shape(1) != 6)
    throw InvalidInput(fmt::format(
        "poses must have the shape ({}, 6): by the shift (mm) and the turn (rad) of each body", bodies));
  Eigen::VectorXd out(6 * bodies);
  for (int b = 0; b < bodies; ++b)
    for (int k = 0; k < 3; ++k) {
      out[6 * b + k] = poses.at(b, 3 + k);
      out[6 * b + 3 + k] = poses.at(b, k) * edge_mm;
    }
  return out;
}

py::array row_of(const Eigen::Matrix4Xd& hinges, int row, double scale = 1) {
  const Eigen::VectorXd numbers = scale * hinges.row(row).transpose();
  return array_of({numbers.begin(), numbers.end()}, {numbers.size()});
}

py::dict dict_of(const model::Sensitivity& by, double edge_mm) {
  py::dict out;
  out["t"] = row_of(by.hinges, 0);
  out["alpha"] = row_of(by.hinges, 1);
  out["beta"] = row_of(by.hinges, 2);
  out["offset_mm"] = row_of(by.hinges, 3, 1 / edge_mm);
  out["theta"] = by.theta;
  out["k_point"] = by.k_point;
  out["k_turn"] = by.k_turn;
  out["reach_mm"] = by.reach_mm;
  out["k_contact"] = by.k_contact;
  return out;
}

}  // namespace

py::dict sensitivity_of(const app::Run& run, const std::optional<Numbers>& poses, double load,
                        double energy) {
  const app::Equilibrium& at = reached_equilibrium(run);
  const double edge_mm = run.design.structure.size().edge_mm;
  model::EquilibriumGradient gradient;
  if (poses) gradient.state = by_state(*poses, run.design.structure.bodies(), edge_mm);
  gradient.load = load;
  gradient.energy = energy;
  model::ElasticSystem system(run.design.structure, at.elasticity, at.drive, at.path.planar, true);
  system.set_multiplier(at.path.multiplier);
  model::State state = at.path.state;
  model::TangentStiffness tangent(system.dofs());
  if (!settle(system, at.path.theta, state, tangent))
    throw InvalidInput("the equilibrium is not stable: its derivatives are not known");
  return dict_of(sensitivity(system, at.elasticity, state, at.path.theta, tangent, gradient), edge_mm);
}

}  // namespace kinetix::python
