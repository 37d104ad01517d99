#include "model/elastic/newton.hpp"

#include <algorithm>
#include <cmath>

namespace kinetix {
namespace {

using Eigen::VectorXd;

constexpr double first_shift = 1e-2;
constexpr double least_shift = 1e-8;
constexpr double shift_decay = 20;
constexpr double tiny_step = 1e-5;
constexpr double most_shift = 1e6;
constexpr double chord_gain = 0.4;
constexpr double polished = 1e-8;
constexpr double energy_noise = 1e-15;

double largest(const VectorXd& v) {
  if (v.size() == 0) return 0;
  return v.allFinite() ? v.lpNorm<Eigen::Infinity>() : NAN;
}

class Newton {
 public:
  Newton(ElasticSystem& system, double theta, const NewtonOptions& options, State& state, Tangent& tangent)
      : system_(system),
        theta_(theta),
        options_(options),
        state_(state),
        tangent_(tangent),
        force_tolerance_(options.force_tolerance *
                         (1 + std::sqrt(static_cast<double>(state.size())))) {}

  NewtonResult run(bool factorised) {
    energy_ = system_.energy(state_, theta_);
    if (factorised) follow_chord(options_.longest_step);
    while (linearise() && std::isfinite(energy_)) {
      if (result_.force <= force_tolerance_ || small_step_) {
        result_.converged = !system_.update_multiplier(state_, theta_, options_.drive_tolerance);
        if (result_.converged) break;
        small_step_ = false;
        energy_ = system_.energy(state_, theta_);
        continue;
      }
      if (result_.iterations++ >= options_.max_iterations || !step() || has_strayed()) break;
    }
    result_.stable = std::isfinite(result_.force) && (factor_holds_ || tangent_.factorise(0));
    return result_;
  }

 private:
  bool linearise() {
    gradient_ = system_.freedoms().restrict(system_.linearise(state_, theta_, tangent_));
    result_.force = largest(gradient_);
    return std::isfinite(result_.force);
  }

  bool has_strayed() const { return shift_ > 0 && !(result_.moved <= options_.most_moved); }

  /// False where no step lowers the energy.
  bool step() {
    if (attempt(0)) return true;
    const double start = shift_ == 0 ? first_shift : std::max(shift_ / shift_decay, least_shift);
    for (double shift = start; shift <= most_shift; shift *= 10) {
      if (!attempt(shift)) continue;
      shift_ = shift;
      return true;
    }
    return false;
  }

  bool attempt(double shift) { return tangent_.factorise(shift) && try_step(shift); }

  bool try_step(double shift) {
    const VectorXd reduced = -tangent_.solve(gradient_);
    const double decrement = -gradient_.dot(reduced) / 2;
    VectorXd step = system_.freedoms().extend(reduced);
    double length = system_.length(state_, step);
    if (!std::isfinite(length)) return false;
    if (length > options_.longest_step) {
      step *= options_.longest_step / length;
      length = options_.longest_step;
    }
    State candidate = system_.stepped(state_, step);
    double energy = system_.energy(candidate, theta_);
    if (!is_better(energy, candidate, length)) return false;
    if (shift > 0) stretch(step, length, candidate, energy);
    const bool levelled = decrement <= options_.energy_tolerance * energy || length <= polished;
    small_step_ = shift == 0 && length <= options_.step_tolerance && levelled;
    factor_holds_ = shift == 0 && is_tiny(length);
    state_ = std::move(candidate);
    energy_ = energy;
    result_.moved += length;
    if (shift == 0) follow_chord(length);
    return true;
  }

  /// A shift holds back a step along negative curvature: it is doubled as long as that lowers the energy.
  void stretch(const VectorXd& step, double& length, State& candidate, double& energy) const {
    for (double by = 2; 2 * length <= options_.longest_step; by *= 2) {
      State further = system_.stepped(state_, by * step);
      const double lower = system_.energy(further, theta_);
      if (!(lower < energy)) return;
      candidate = std::move(further);
      energy = lower;
      length *= 2;
    }
  }

  /// Steps by the factor that there is, as long as each is much shorter than the one before.
  void follow_chord(double length) {
    while (length > std::min(options_.step_tolerance, polished)) {
      const VectorXd gradient = system_.freedoms().restrict(system_.gradient(state_, theta_));
      const VectorXd step = -system_.freedoms().extend(tangent_.solve(gradient));
      const double next = system_.length(state_, step);
      if (!(next <= chord_gain * length)) return;
      State candidate = system_.stepped(state_, step);
      const double energy = system_.energy(candidate, theta_);
      if (!(energy < energy_)) return;
      state_ = std::move(candidate);
      energy_ = energy;
      factor_holds_ = factor_holds_ && is_tiny(next);
      length = next;
    }
  }

  bool is_tiny(double length) const { return length <= std::max(tiny_step, options_.step_tolerance); }

  bool is_better(double energy, const State& candidate, double length) const {
    if (!std::isfinite(energy)) return false;
    if (energy < energy_ - energy_noise * std::abs(energy_)) return true;
    if (length > 1e-4) return false;
    const VectorXd gradient = system_.freedoms().restrict(system_.gradient(candidate, theta_));
    return largest(gradient) <= result_.force || length <= options_.step_tolerance;
  }

  ElasticSystem& system_;
  const double theta_;
  const NewtonOptions& options_;
  State& state_;
  Tangent& tangent_;
  const double force_tolerance_;
  NewtonResult result_;
  VectorXd gradient_;
  double energy_ = 0, shift_ = 0;
  bool small_step_ = false;
  bool factor_holds_ = false;  ///< of a state a tiny step before
};

}  // namespace

NewtonResult minimise(ElasticSystem& system, double theta, const NewtonOptions& options, State& state,
                      Tangent& tangent, bool factorised) {
  return Newton(system, theta, options, state, tangent).run(factorised);
}

}  // namespace kinetix
