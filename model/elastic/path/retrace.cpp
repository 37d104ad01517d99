#include "model/elastic/path/retrace.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure/closure_drive.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/path/closed_form.hpp"

namespace kinetix::model {
namespace {

constexpr double back_step = 1e-3;  // rad of theta
constexpr int least_steps = 10,
              most_steps = 64;      // backwards over a jump: bounds of the number of steps
constexpr double same_turn = 1e-3;  // rad of a hinge
/// Fraction of the energy before: tolerance between two settled states.
constexpr double same_energy = 1e-6;

}  // namespace

Retrace::Finding Retrace::back(const Place& after, const Place& before) {
  if (!system_) system_.emplace(driven_.linkage, elasticity_, driven_.drive, options_);
  ElasticSystem& elastic = system_->elastic;
  const double way = before.theta - after.theta;
  const int steps =
      std::clamp(static_cast<int>(std::ceil(std::abs(way) / back_step)), least_steps, most_steps);
  State state = after.state;
  elastic.set_multiplier(after.multiplier);
  for (int k = 0; k <= steps; ++k)
    if (!settle(after.theta + way * k / steps, state)) return Finding::unknown;
  State first = before.state;
  elastic.set_multiplier(before.multiplier);
  if (!settle(before.theta, first)) return Finding::unknown;
  const Linkage& structure = elastic.structure();
  const double apart = turn_distance(structure, state, first);
  if (apart <= same_turn) return Finding::reversible;
  const double energy = elastic.stored_energy(first, before.theta);
  if (std::abs(energy - elastic.stored_energy(state, before.theta)) > same_energy * energy)
    return Finding::lossy;
  const bool is_mirrored =
      apart > ClosedForm::far && mean_theta(structure, state) * mean_theta(structure, first) < 0;
  return is_mirrored ? Finding::mirrored : Finding::reversible;
}

bool Retrace::settle(double theta, State& state) {
  system_->elastic.place(theta, state);
  const NewtonResult found = minimise(system_->elastic, theta, options_.newton, state, system_->tangent);
  return found.converged && found.stable;
}

}  // namespace kinetix::model
