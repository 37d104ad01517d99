#include "model/elastic/path/branch.hpp"

#include "model/elastic/lowest_mode.hpp"

namespace kinetix::model {
namespace {

using Eigen::VectorXd;

constexpr double first_seed = 1e-3;    // rad, cell edges: first step along the lowest mode
constexpr double slender_seed = 1e-5;  // rad, cell edges: first step if the valley curves away sooner
constexpr double nearby = 0.05;  // rad, cell edges: a longer step of Newton's method is not a relaxation
// Rad, cell edges: start of Newton's method if neither seed lowers the energy.
constexpr double curved_valley = 0.05;
constexpr double longest_step = 0.3;   // rad, cell edges: a seed doubles up to it while the energy falls
constexpr double checkerboard = 1e-3;  // share of all turns: below, a mode has no class, and `side` decides

/// Returns the state after one step of Newton's method. It activates the forces in the hinges, and the
/// bending that these cause.
State relaxed(const ElasticSystem& system, double theta, const State& exact, TangentStiffness& tangent) {
  const VectorXd gradient = system.dofs().restrict(system.linearise(exact, theta, tangent));
  if (!tangent.factorise(0)) return exact;
  const VectorXd step = -system.dofs().extend(tangent.solve(gradient));
  return system.length(exact, step) <= nearby ? system.retract(exact, step) : exact;
}

/// Returns a state of lower energy along a direction. @param along of length 1
State downhill(const ElasticSystem& system, double theta, const State& from, const VectorXd& along) {
  const auto at = [&](double s) { return system.retract(from, s * along); };
  const auto energy = [&](double s) { return system.energy(at(s), theta); };
  const double least = system.energy(from, theta);
  double s = energy(first_seed) < least ? first_seed : slender_seed;
  if (!(energy(s) < least)) return at(curved_valley);
  while (2 * s <= longest_step && energy(2 * s) < energy(s)) s *= 2;
  return at(s);
}

/// Returns the sign that gives the largest entry of a mode the sign of `side`.
double side_of_largest(const VectorXd& mode, int side) {
  Eigen::Index largest = 0;
  mode.cwiseAbs().maxCoeff(&largest);
  return side * std::copysign(1.0, mode[largest]);
}

/// Returns the sign that turns class A as the drive does. For a mode without turns of the checkerboard,
/// `side` decides.
double side_of_drive(const ElasticSystem& system, const VectorXd& mode, int side) {
  const auto& bodies = system.structure().bodies;
  double with = 0, size = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    with += bodies[b].first_turn().dot(mode.segment<3>(6 * b));
    size += mode.segment<3>(6 * b).norm();
  }
  if (std::abs(with) > checkerboard * size && size > 0)
    return std::copysign(1.0, with * system.drive().theta());
  return side_of_largest(mode, side);
}

}  // namespace

Branch::Start Branch::leave(double theta, const State& from, TangentStiffness& tangent) const {
  if (const auto exact = closed_form_.at(theta))
    if (system_.energy(*exact, theta) < system_.energy(from, theta))
      return onto_closed_form(theta, *exact, tangent);
  return along_lowest_mode(theta, from, tangent, false);
}

double Branch::side_of(const VectorXd& along) const { return side_of_drive(system_, along, side_); }

Branch::Start Branch::onto_closed_form(double theta, const State& exact, TangentStiffness& tangent) const {
  const State equilibrium = relaxed(system_, theta, exact, tangent);
  system_.linearise(equilibrium, theta, tangent);
  if (tangent.factorise(0)) return {Descent::closed_form, equilibrium};
  Start off = along_lowest_mode(theta, equilibrium, tangent, true);
  const bool lower = off.descent == Descent::lowest_mode &&
                     system_.energy(off.state, theta) < system_.energy(equilibrium, theta);
  if (!lower) return {Descent::closed_form, exact};
  off.descent = Descent::off_closed_form;
  return off;
}

Branch::Start Branch::along_lowest_mode(double theta, const State& from, TangentStiffness& tangent,
                                        bool is_folded) const {
  const LowestMode lowest = lowest_mode(tangent);
  if (!lowest.converged) return {};
  if (!(lowest.value < 0)) return {Descent::none, from};
  const VectorXd mode = system_.dofs().extend(lowest.direction);
  const double sign = is_folded ? side_of_largest(mode, side_) : side_of_drive(system_, mode, side_);
  return {Descent::lowest_mode, downhill(system_, theta, from, sign / system_.length(from, mode) * mode)};
}

}  // namespace kinetix::model
