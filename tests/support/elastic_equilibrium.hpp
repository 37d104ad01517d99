#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>

#include "model/closure/closure.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/random_elastic.hpp"

/// Equilibria of elastic structures, found again after a parameter changes.
namespace kinetix::testing {

struct Equilibrium {
  model::Structure structure;
  model::Elasticity elasticity;
  model::Drive drive;
  double theta = 0;
  bool planar = false;
  model::State state;
  double multiplier = 0;
  double load = 0, energy = 0;  ///< N or N mm; N mm
  std::vector<model::Contact> contacts = {};
  bool found = false;  ///< converged and stable
};

/// Runs Newton's method from the state of `b`, to rounding.
inline void settle(Equilibrium& b) {
  model::ElasticSystem system(b.structure, b.elasticity, drive_on(b.structure, b.drive), b.planar, true);
  system.set_multiplier(b.multiplier);
  system.place(b.theta, b.state);
  model::TangentStiffness tangent(system.dofs());
  model::NewtonOptions options;
  options.force_tolerance = 0;
  options.drive_tolerance = 1e-15;
  const model::NewtonResult result = minimise(system, b.theta, options, b.state, tangent);
  const double L = b.structure.size.edge_mm, unit = b.elasticity.k_point * L;
  b.found = result.converged && result.stable;
  b.multiplier = system.multiplier();
  b.load = system.load(b.state, b.theta) * unit * (system.drive().has_force() ? 1 : L);
  b.energy = system.elastic_energy(b.state) * unit * L;
  b.contacts = system.contacts(b.state);
}

/// Returns the equilibrium folded from flat by a drive.
inline Equilibrium equilibrium(const model::Structure& structure, const model::Elasticity& elasticity,
                               const model::Drive& drive, bool planar) {
  model::EquilibriumPathOptions options;
  options.planar = planar;
  const model::EquilibriumPath path = trace_equilibrium(driven(structure, drive), elasticity, options);
  Equilibrium b{structure, elasticity, drive, path.theta, planar, path.state, path.multiplier};
  settle(b);
  b.found = b.found && path.stop == model::EquilibriumPath::Stop::reached;
  return b;
}

/// Returns the widths of the groups of parameters. First are t, alpha, beta and offset of all hinges, and theta, by
/// their change. Then k_point, k_turn, reach_mm and k_contact follow, by their relative change.
inline std::vector<Eigen::Index> parameter_groups(const Equilibrium& b) {
  const auto hinges = static_cast<Eigen::Index>(b.structure.hinges.size());
  return {hinges, hinges, hinges, hinges, 1, 1, 1, 1, 1};
}

inline Eigen::Index parameter_count(const Equilibrium& b) { return 4 * b.structure.hinges.size() + 5; }

/// Returns the equilibrium found from `from` after its parameters have changed by q.
inline Equilibrium changed(const Equilibrium& from, const Eigen::VectorXd& q) {
  Equilibrium b = from;
  Eigen::Index k = 0;
  for (double model::HingeParameters::*field :
       {&model::HingeParameters::t, &model::HingeParameters::alpha, &model::HingeParameters::beta,
        &model::HingeParameters::offset})
    for (model::Hinge& hinge : b.structure.hinges) hinge.parameters.*field += q[k++];
  b.theta += q[k++];
  for (double model::Elasticity::*field : {&model::Elasticity::k_point, &model::Elasticity::k_turn,
                                           &model::Elasticity::reach_mm, &model::Elasticity::k_contact})
    b.elasticity.*field *= 1 + q[k++];
  settle(b);
  return b;
}

/// Returns a sensitivity as a row over the parameters of parameter_groups().
inline Eigen::RowVectorXd packed(const Equilibrium& b, const model::Sensitivity& s) {
  Eigen::RowVectorXd out(parameter_count(b));
  const model::Elasticity& e = b.elasticity;
  out << s.hinges.row(0), s.hinges.row(1), s.hinges.row(2), s.hinges.row(3), s.theta, s.k_point * e.k_point,
      s.k_turn * e.k_turn, s.reach_mm * e.reach_mm, s.k_contact * e.k_contact;
  return out;
}

/// Function of a state with its derivatives by the state.
struct StateFunction {
  std::string name;
  std::function<double(const Equilibrium&)> value;
  std::function<model::EquilibriumGradient(const Equilibrium&)> gradient;
};

/// Returns a function of the state alone, with numeric derivatives.
inline StateFunction state_function(std::string name,
                                    std::function<double(const model::Structure&, const model::State&)> f) {
  const auto gradient = [f](const Equilibrium& b) {
    const model::Linkage linkage = b.structure;
    const auto moved_value = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd::Constant(1, f(b.structure, retract_straight(linkage, b.state, x)));
    };
    return model::EquilibriumGradient{
        numeric_jacobian(moved_value, Eigen::VectorXd::Zero(6 * b.state.size()), 3e-3).transpose()};
  };
  return {std::move(name), [f](const Equilibrium& b) { return f(b.structure, b.state); }, gradient};
}

/// Returns the sum of all coordinates with different weights, cell edges.
inline double weighted_sum(const model::Structure& s, const model::State& state) {
  double sum = 0;
  for (std::size_t b = 0; b < state.size(); ++b) {
    const double w = 1 + std::sin(static_cast<double>(b));
    sum += w * state[b].p.dot(Eigen::Vector3d(0.3, -1, 0.7)) / s.size.edge_mm;
    sum += w * (state[b].R * Eigen::Vector3d(0.5, 0.2, 0.1)).dot(Eigen::Vector3d(-0.4, 0.8, 1));
  }
  return sum;
}

/// Returns how much more open the first cell is than the last, cell edges squared.
inline double opening_contrast(const model::Structure& s, const model::State& state) {
  const auto opening = [&](const model::CellHinges& cell) {
    const auto diagonal = [&](int k) -> Eigen::Vector3d {
      return (state[cell.bodies[k + 2]].p - state[cell.bodies[k]].p) / s.size.edge_mm;
    };
    return 0.5 * diagonal(0).cross(diagonal(1)).norm();
  };
  return opening(s.cell_members.front()) - opening(s.cell_members.back());
}

inline std::vector<StateFunction> state_functions() {
  return {state_function("weighted sum of positions and turns", weighted_sum),
          state_function("difference of two openings", opening_contrast),
          {"load", [](const Equilibrium& b) { return b.load; },
           [](const Equilibrium&) {
             return model::EquilibriumGradient{{}, 1, 0};
           }},
          {"energy", [](const Equilibrium& b) { return b.energy; },
           [](const Equilibrium&) {
             return model::EquilibriumGradient{{}, 0, 1};
           }},
          {"product of load and energy", [](const Equilibrium& b) { return b.load * b.energy; },
           [](const Equilibrium& b) {
             return model::EquilibriumGradient{{}, b.energy, b.load};
           }}};
}

/// Returns the Jacobian by the adjoint method, with the rows of state_functions().
inline Eigen::MatrixXd adjoint_jacobian(const Equilibrium& b) {
  model::ElasticSystem system(b.structure, b.elasticity, drive_on(b.structure, b.drive), b.planar, true);
  system.set_multiplier(b.multiplier);
  model::TangentStiffness tangent(system.dofs());
  system.linearise(b.state, b.theta, tangent);
  tangent.factorise(0);
  const auto functions = state_functions();
  Eigen::MatrixXd out(functions.size(), parameter_count(b));
  for (std::size_t k = 0; k < functions.size(); ++k)
    out.row(k) =
        packed(b, sensitivity(system, b.elasticity, b.state, b.theta, tangent, functions[k].gradient(b)));
  return out;
}

struct Differenced {
  Eigen::MatrixXd jacobian;   ///< NaN unless same_contacts
  bool same_contacts = true;  ///< all equilibria were found, with the points in contact that the first has
};

inline Differenced differenced_jacobian(const Equilibrium& b, double step) {
  Differenced out;
  const std::vector<StateFunction> functions = state_functions();
  const auto values = [&](const Eigen::VectorXd& q) {
    Eigen::VectorXd all = Eigen::VectorXd::Constant(functions.size(), NAN);
    if (!out.same_contacts) return all;
    const Equilibrium at = changed(b, q);
    out.same_contacts = at.found && at.contacts == b.contacts;
    for (std::size_t k = 0; k < functions.size(); ++k) all[k] = functions[k].value(at);
    return all;
  };
  out.jacobian = numeric_jacobian(values, Eigen::VectorXd::Zero(parameter_count(b)), step);
  return out;
}

/// Returns the Jacobian by central differences, with steps so short that no point comes into contact or leaves it. It
/// is the mean of several Jacobians. Shorter steps need more of them, since rounding is larger.
inline Differenced differenced_jacobian(const Equilibrium& b) {
  double step = 1e-3;
  Differenced out = differenced_jacobian(b, step);
  while (!out.same_contacts && step > 1e-4) out = differenced_jacobian(b, step /= 2);
  const int more = static_cast<int>(2e-4 / step);  // 0 except for the two shortest steps
  for (int k = 1; k <= more; ++k) out.jacobian += differenced_jacobian(b, step * (1 - 0.1 * k)).jacobian;
  out.jacobian /= 1 + more;
  return out;
}

/// Random 3 x 2 panel in equilibrium. Walls of a third of the cell touch at the theta to which it is driven.
struct EquilibriumCase {
  unsigned seed = 0;
  bool planar = false, plates = false, touching = false;
};

inline std::vector<EquilibriumCase> equilibrium_cases(unsigned repeats) {
  std::vector<EquilibriumCase> cases;
  for (unsigned seed = 1; seed <= repeats; ++seed)
    for (const bool planar : {true, false})
      for (const bool plates : {true, false})
        for (const bool touching : {true, false}) cases.push_back({seed, planar, plates, touching});
  return cases;
}

inline std::string to_string(const EquilibriumCase& c) {
  return std::string(c.planar ? "planar" : "spatial") + (c.plates ? ", plates" : ", driven hinge") +
         (c.touching ? ", in contact" : ", free") + ", seed " + std::to_string(c.seed);
}

inline Equilibrium random_equilibrium(const EquilibriumCase& c) {
  std::mt19937 random(c.seed);
  const auto draw = [&] {
    model::Structure s = random_panel(3, 2, random, c.planar);
    for (std::size_t k = 0; k < s.hinges.size(); ++k) {
      model::HingeParameters& p = s.hinges[k].parameters;
      p.t = 0.5 + (p.t - 0.5) / 2;
      p.offset = (c.touching ? 0.01 : 0.05) * std::cos(static_cast<double>(k));
    }
    if (c.touching) s.size.thickness_mm = 4.8;
    return s;
  };
  // Walls stay apart where central differences move their hinges.
  const auto overlaps = [](model::Structure s) {
    s.size.thickness_mm *= 1.02;
    return model::WallContact(s).overlap_at_rest().has_value();
  };
  model::Structure s = draw();
  while (overlaps(s)) s = draw();
  const double theta = c.touching ? 0.45 : 0.35;
  const model::Drive drive =
      c.plates ? plates_drive(model::Axis::y, theta) : hinge_drive(s, {{1, 1}, model::Axis::x}, theta);
  return equilibrium(s, {1000, 20, 3, 3000}, drive, c.planar);
}

}  // namespace kinetix::testing
