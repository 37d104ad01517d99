#include "model/elastic/newton.hpp"

namespace kinetix::model {
namespace {

/// Step of a truncated Newton method: an approximate minimum of g . x + x . H x / 2.
struct TruncatedStep {
  enum class Outcome {
    solved,    ///< its residual is small
    negative,  ///< it ends along a direction of negative curvature, downhill
    slow,      ///< neither, after `most` iterations
  };
  Eigen::VectorXd step;  ///< rad and cell edges, as the unknowns
  Outcome outcome = Outcome::slow;
};

/// Computes a step by preconditioned conjugate gradients after Steihaug (1983). H is the present tangent. Its
/// last factor, that of a nearby state or of a shifted tangent, is the preconditioner. `solved` means a
/// residual of 2 % of the first one in the norm of the preconditioner, or of 30 % after the last iteration.
/// @pre tangent.is_factorised()
TruncatedStep conjugate_gradients(TangentStiffness& tangent, const Eigen::VectorXd& gradient, int most = 20);

using Eigen::VectorXd;
using Outcome = TruncatedStep::Outcome;

// Ratio to the first residual, in the norm of the preconditioner. This is as accurate as a factor of the
// tangent for one step of Newton's method. The next step makes further iterations unnecessary.
constexpr double solved = 0.02;
constexpr double good_enough = 0.3;  // after the last iteration; above it, a new factor is faster

TruncatedStep conjugate_gradients(TangentStiffness& tangent, const VectorXd& gradient, int most) {
  VectorXd x = VectorXd::Zero(gradient.size()), residual = -gradient;
  VectorXd direction = tangent.solve(residual);
  const double first = residual.dot(direction);
  double size = first;
  for (int k = 0; k < most && size > 0; ++k) {
    const VectorXd curved = tangent.multiply(direction);
    const double curvature = direction.dot(curved);
    if (!(curvature > 0)) {
      if (k > 0) direction *= x.norm() / direction.norm();
      return {x + direction, Outcome::negative};
    }
    const double length = size / curvature;
    x += length * direction;
    residual -= length * curved;
    const VectorXd next = tangent.solve(residual);
    const double next_size = residual.dot(next);
    if (next_size <= solved * solved * first) return {x, Outcome::solved};
    direction = next + next_size / size * direction;
    size = next_size;
  }
  return {x, size <= good_enough * good_enough * first ? Outcome::solved : Outcome::slow};
}

constexpr double first_shift = 1e-2;  // k_point edge^2: high, since a step that is too short is stretched
// k_point edge^2: smallest initial shift. A smaller one has no effect next to the turning stiffness of a
// usual hinge, 1e-6.
constexpr double min_shift = 1e-8;
// Divisor of the last shift, for the initial shift of the next step. An unnecessary shift vanishes within a
// few steps.
constexpr double shift_decay = 20;
constexpr double tiny_step = 1e-5;  // rad, cell edges: a factor from before such a step is accurate after it
constexpr double max_shift = 1e6;   // k_point edge^2: with larger shifts, steps have practically no length
constexpr int max_shortened = 6;    // cuts of a step, at least to half each: a shift is better after that
// Rad, cell edges: energy differences of shorter steps are rounding; forces are still accurate.
constexpr double too_short = 1e-4;
constexpr double chord_gain = 0.4;  // ratio of a step to the one before; above it, a new factor is cheaper
constexpr double polished = 1e-8;   // rad, cell edges: the square of so short a step is rounding
constexpr double energy_noise = 1e-15;  // fraction of the energy: a smaller gain may be rounding
constexpr int iterative_from = 1500;    // unknowns: in smaller systems, a new factor costs less
constexpr double rough = 1e-4;          // rad, cell edges: at finer tolerances, an old factor does not help

double largest(const VectorXd& v) {
  if (v.size() == 0) return 0;
  return v.allFinite() ? v.lpNorm<Eigen::Infinity>() : NAN;
}

class Newton {
 public:
  Newton(ElasticSystem& system, double theta, const NewtonOptions& options, State& state,
         TangentStiffness& tangent)
      : system_(system),
        theta_(theta),
        options_(options),
        state_(state),
        tangent_(tangent),
        force_tolerance_(options.force_tolerance * (1 + std::sqrt(static_cast<double>(state.size())))) {}

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
    result_.stable = result_.converged && (factor_holds_ || tangent_.factorise(0));
    return result_;
  }

 private:
  bool linearise() {
    gradient_ = system_.dofs().restrict(system_.linearise(state_, theta_, tangent_));
    result_.force = largest(gradient_);
    return std::isfinite(result_.force);
  }

  bool has_strayed() const { return shift_ > 0 && !(result_.moved <= options_.most_moved); }

  /// Takes one step. @return false if no step lowers the energy
  bool step() {
    const bool only_convex = options_.starts_convex && result_.iterations == 1;
    if (is_iterative()) {
      const TruncatedStep truncated = conjugate_gradients(tangent_, gradient_);
      const bool negative = truncated.outcome == TruncatedStep::Outcome::negative;
      if (negative && only_convex) return false;
      result_.was_indefinite = result_.was_indefinite || negative;
      if (truncated.outcome != TruncatedStep::Outcome::slow && try_step(truncated.step, negative, false))
        return true;
    }
    if (attempt(0)) return true;
    if (only_convex && !tangent_.is_factorised()) return false;
    const double start = shift_ == 0 ? first_shift : std::max(shift_ / shift_decay, min_shift);
    for (double shift = start; shift <= max_shift; shift *= 10) {
      if (!attempt(shift)) continue;
      shift_ = shift;
      result_.was_indefinite = true;
      return true;
    }
    return false;
  }

  bool is_iterative() const {
    return tangent_.is_factorised() && tangent_.size() >= iterative_from && options_.step_tolerance >= rough;
  }

  bool attempt(double shift) {
    return tangent_.factorise(shift) && try_step(-tangent_.solve(gradient_), shift > 0, shift == 0);
  }

  /// Tries a step. @param held_back whether a shift or truncation shortens it   @param exact whether the
  /// factor is of the tangent without a shift
  bool try_step(const VectorXd& reduced, bool held_back, bool exact) {
    const double decrement = -gradient_.dot(reduced) / 2;
    VectorXd step = system_.dofs().extend(reduced);
    const double whole = system_.length(state_, step);
    if (!std::isfinite(whole)) return false;
    double length = whole;
    if (length > options_.longest_step) {
      step *= options_.longest_step / length;
      length = options_.longest_step;
    }
    State candidate = system_.retract(state_, step);
    double energy = system_.energy(candidate, theta_);
    if (!is_better(energy, candidate, length) &&
        !shorten(step, length, gradient_.dot(reduced) * length / whole, candidate, energy))
      return false;
    if (held_back) stretch(step, length, candidate, energy);
    const bool levelled = decrement <= options_.energy_tolerance * energy || length <= polished;
    small_step_ = !held_back && length <= options_.step_tolerance && levelled;
    factor_holds_ = exact && is_tiny(length);
    state_ = std::move(candidate);
    energy_ = energy;
    result_.moved += length;
    if (exact) follow_chord(length);
    return true;
  }

  /// Shortens the step repeatedly to the minimum of a parabola through the energies at both ends.
  /// @param slope of the energy along the step, times the step
  /// @return whether the energy is lower
  bool shorten(VectorXd& step, double& length, double slope, State& candidate, double& energy) const {
    for (int tries = 0; tries < max_shortened && length > too_short; ++tries) {
      const double parabola = -slope / (2 * (energy - energy_ - slope));
      const double by = std::isfinite(parabola) ? std::clamp(parabola, 0.1, 0.5) : 0.25;
      step *= by;
      length *= by;
      slope *= by;
      candidate = system_.retract(state_, step);
      energy = system_.energy(candidate, theta_);
      if (is_better(energy, candidate, length)) return true;
    }
    return false;
  }

  /// Doubles a step along negative curvature, which a shift makes too short, while that lowers the energy.
  void stretch(const VectorXd& step, double& length, State& candidate, double& energy) const {
    for (double by = 2; 2 * length <= options_.longest_step; by *= 2) {
      State further = system_.retract(state_, by * step);
      const double lower = system_.energy(further, theta_);
      if (!(lower < energy)) return;
      candidate = std::move(further);
      energy = lower;
      length *= 2;
    }
  }

  /// Takes steps with the present factor, as long as each is much shorter than the one before.
  void follow_chord(double length) {
    while (length > std::min(options_.step_tolerance, polished)) {
      const VectorXd gradient = system_.dofs().restrict(system_.gradient(state_, theta_));
      const VectorXd step = -system_.dofs().extend(tangent_.solve(gradient));
      const double next = system_.length(state_, step);
      if (!(next <= chord_gain * length)) return;
      State candidate = system_.retract(state_, step);
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
    if (length > too_short) return false;
    const VectorXd gradient = system_.dofs().restrict(system_.gradient(candidate, theta_));
    return largest(gradient) <= result_.force || length <= options_.step_tolerance;
  }

  ElasticSystem& system_;
  const double theta_;
  const NewtonOptions& options_;
  State& state_;
  TangentStiffness& tangent_;
  const double force_tolerance_;
  NewtonResult result_;
  VectorXd gradient_;
  double energy_ = 0, shift_ = 0;
  bool small_step_ = false;
  bool factor_holds_ = false;  ///< is that of a state a tiny step before
};

}  // namespace

NewtonResult minimise(ElasticSystem& system, double theta, const NewtonOptions& options, State& state,
                      TangentStiffness& tangent, bool factorised) {
  return Newton(system, theta, options, state, tangent).run(factorised);
}

bool settle(ElasticSystem& system, double theta, State& state, TangentStiffness& tangent) {
  const NewtonResult settled = minimise(system, theta, {}, state, tangent);
  if (!settled.converged || !settled.stable) return false;
  system.linearise(state, theta, tangent);
  return tangent.factorise(0);
}

}  // namespace kinetix::model
