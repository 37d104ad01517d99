#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>

#include "model/closure.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/load_path.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/random_elastic.hpp"

/// Balances of elastic structures that are found anew where a parameter changes.
namespace kinetix::testing {

struct Balance {
  Structure structure;
  Elasticity elasticity;
  Drive drive;
  double theta = 0;
  bool planar = false;
  State state;
  double multiplier = 0;
  double load = 0, energy = 0;  ///< N or N mm; N mm
  std::vector<Contact> contacts = {};
  bool found = false;  ///< converged and stable
};

/// Newton's method from the state that `b` has, to rounding.
inline void settle(Balance& b) {
  ElasticSystem system(b.structure, b.elasticity, b.drive, b.planar, true);
  system.set_multiplier(b.multiplier);
  system.place(b.theta, b.state);
  Tangent tangent(system.freedoms());
  NewtonOptions options;
  options.force_tolerance = 0;
  options.drive_tolerance = 1e-15;
  const NewtonResult result = minimise(system, b.theta, options, b.state, tangent);
  const double L = b.structure.size.edge_mm, unit = b.elasticity.k_point * L;
  b.found = result.converged && result.stable;
  b.multiplier = system.multiplier();
  b.load = system.load(b.state, b.theta) * unit * (b.drive.kind == Drive::Kind::plates ? 1 : L);
  b.energy = system.elastic_energy(b.state) * unit * L;
  b.contacts = system.contacts(b.state);
}

/// Folded from flat by a drive.
inline Balance balance(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
                       bool planar) {
  LoadPathOptions options;
  options.planar = planar;
  const LoadPath path = follow_load(structure, elasticity, drive, options);
  Balance b{structure, elasticity, drive, path.theta, planar, path.state, path.multiplier};
  settle(b);
  b.found = b.found && path.stop == LoadPath::Stop::reached;
  return b;
}

/// All parameters, one group after the other: t, then alpha, then beta of all hinges and theta, by their
/// change; k_point, k_turn, reach_mm, k_contact by their relative change.
inline std::vector<Eigen::Index> parameter_groups(const Balance& b) {
  const auto hinges = static_cast<Eigen::Index>(b.structure.hinges.size());
  return {hinges, hinges, hinges, 1, 1, 1, 1, 1};
}

inline Eigen::Index parameter_count(const Balance& b) { return 3 * b.structure.hinges.size() + 5; }

/// The balance found anew from `from` after its parameters have changed.
inline Balance changed(const Balance& from, const Eigen::VectorXd& q) {
  Balance b = from;
  Eigen::Index k = 0;
  for (double HingeParameters::*field :
       {&HingeParameters::t, &HingeParameters::alpha, &HingeParameters::beta})
    for (Hinge& hinge : b.structure.hinges) hinge.parameters.*field += q[k++];
  b.theta += q[k++];
  for (double Elasticity::*field :
       {&Elasticity::k_point, &Elasticity::k_turn, &Elasticity::reach_mm, &Elasticity::k_contact})
    b.elasticity.*field *= 1 + q[k++];
  settle(b);
  return b;
}

/// A sensitivity as a row over the same parameters.
inline Eigen::RowVectorXd packed(const Balance& b, const Sensitivity& s) {
  Eigen::RowVectorXd out(parameter_count(b));
  const Elasticity& e = b.elasticity;
  out << s.hinges.row(0), s.hinges.row(1), s.hinges.row(2), s.theta, s.k_point * e.k_point,
      s.k_turn * e.k_turn, s.reach_mm * e.reach_mm, s.k_contact * e.k_contact;
  return out;
}

/// A function of a state with its derivatives by the state.
struct StateFunction {
  std::string name;
  std::function<double(const Balance&)> value;
  std::function<BalanceGradient(const Balance&)> gradient;
};

/// One of the state alone; the derivatives are numeric.
inline StateFunction state_function(std::string name,
                                    std::function<double(const Structure&, const State&)> f) {
  const auto gradient = [f](const Balance& b) {
    const auto moved_value = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd::Constant(1, f(b.structure, moved(b.structure, b.state, x)));
    };
    return BalanceGradient{
        numeric_jacobian(moved_value, Eigen::VectorXd::Zero(6 * b.state.size()), 3e-3).transpose()};
  };
  return {std::move(name), [f](const Balance& b) { return f(b.structure, b.state); }, gradient};
}

/// Sum of all coordinates with weights of their own, cell edges.
inline double weighted_sum(const Structure& s, const State& state) {
  double sum = 0;
  for (std::size_t b = 0; b < state.size(); ++b) {
    const double w = 1 + std::sin(static_cast<double>(b));
    sum += w * state[b].p.dot(Eigen::Vector3d(0.3, -1, 0.7)) / s.size.edge_mm;
    sum += w * (state[b].R * Eigen::Vector3d(0.5, 0.2, 0.1)).dot(Eigen::Vector3d(-0.4, 0.8, 1));
  }
  return sum;
}

/// How much more open the first cell is than the last, cell edges squared.
inline double opening_contrast(const Structure& s, const State& state) {
  const auto opening = [&](const CellHinges& cell) {
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
          {"load", [](const Balance& b) { return b.load; },
           [](const Balance&) {
             return BalanceGradient{{}, 1, 0};
           }},
          {"energy", [](const Balance& b) { return b.energy; },
           [](const Balance&) {
             return BalanceGradient{{}, 0, 1};
           }},
          {"product of load and energy", [](const Balance& b) { return b.load * b.energy; },
           [](const Balance& b) {
             return BalanceGradient{{}, b.energy, b.load};
           }}};
}

/// Rows as of state_functions().
inline Eigen::MatrixXd adjoint_jacobian(const Balance& b) {
  ElasticSystem system(b.structure, b.elasticity, b.drive, b.planar, true);
  system.set_multiplier(b.multiplier);
  Tangent tangent(system.freedoms());
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
  Eigen::MatrixXd jacobian;
  bool same_contacts = true;  ///< all balances were found, with the points in contact that the first has
};

inline Differenced differenced_jacobian(const Balance& b, double step) {
  Differenced out;
  const auto values = [&](const Eigen::VectorXd& q) {
    const Balance at = changed(b, q);
    out.same_contacts = out.same_contacts && at.found && at.contacts == b.contacts;
    Eigen::VectorXd all(state_functions().size());
    Eigen::Index k = 0;
    for (const StateFunction& f : state_functions()) all[k++] = f.value(at);
    return all;
  };
  out.jacobian = numeric_jacobian(values, Eigen::VectorXd::Zero(parameter_count(b)), step);
  return out;
}

/// The same by central differences, with steps so short that no point comes into contact or leaves it.
inline Differenced differenced_jacobian(const Balance& b) {
  double step = 1e-3;
  Differenced out = differenced_jacobian(b, step);
  while (!out.same_contacts && step > 1e-4) out = differenced_jacobian(b, step /= 2);
  return out;
}

/// A random 3 x 2 panel in balance. Walls of a third of the cell touch at the theta to which it is driven.
struct BalanceCase {
  unsigned seed = 0;
  bool planar = false, plates = false, touching = false;
};

inline std::vector<BalanceCase> balance_cases(unsigned repeats) {
  std::vector<BalanceCase> cases;
  for (unsigned seed = 1; seed <= repeats; ++seed)
    for (const bool planar : {true, false})
      for (const bool plates : {true, false})
        for (const bool touching : {true, false}) cases.push_back({seed, planar, plates, touching});
  return cases;
}

inline std::string to_string(const BalanceCase& c) {
  return std::string(c.planar ? "planar" : "spatial") + (c.plates ? ", plates" : ", driven hinge") +
         (c.touching ? ", in contact" : ", free") + ", seed " + std::to_string(c.seed);
}

inline Balance random_balance(const BalanceCase& c) {
  std::mt19937 random(c.seed);
  Structure s = random_panel(3, 2, random, c.planar);
  for (Hinge& hinge : s.hinges) hinge.parameters.t = 0.5 + (hinge.parameters.t - 0.5) / 2;
  if (c.touching) s.size.thickness_mm = 4.8;
  const double theta = c.touching ? 0.45 : 0.35;
  const Drive drive = c.plates ? plates_drive(Axis::y, theta) : hinge_drive({{1, 1}, Axis::x}, theta);
  return balance(s, {1000, 20, 3, 3000}, drive, c.planar);
}

}  // namespace kinetix::testing
