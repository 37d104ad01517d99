#include "model/elastic/path/turning_points.hpp"

#include "model/closure/drive_theta.hpp"
#include "model/elastic/path/measured_system.hpp"

namespace kinetix::model {
namespace {

constexpr double limit_accuracy = 1e-8;  // rad of theta, of a limit point
constexpr double prominent = 0.02;  // fraction of the largest load so far: least prominence of a limit point
constexpr double theta_accuracy = 1e-7;  // rad of theta: the energy error at a maximum is only its square
constexpr double vanishing = 1e-4;  // ratio to the larger load at both ends: a larger residual means a jump
/// Bisection alone needs 24 equilibria from 1 rad to the accuracy of theta.
constexpr int max_equilibria = 60;

class Summit {
 public:
  Summit(const Linkage& structure, const Elasticity& elasticity, const LinkageDrive& drive,
         const EquilibriumPathOptions& options)
      : system_(structure, elasticity, drive, options), newton_(options.newton) {}

  /// Finds the limit point of the load in a turn.
  std::optional<EquilibriumStep> limit(const LoadTurns::Turn& turn) {
    Side low{turn.before, turn.before.step.stiffness}, high{turn.after, turn.after.step.stiffness};
    for (int k = 0; k < max_equilibria; ++k) {
      const double theta = (low.theta() * high.load - high.theta() * low.load) / (high.load - low.load);
      const double from_low = std::abs(theta - low.theta()), from_high = std::abs(theta - high.theta());
      const auto next = equilibrium(theta, from_low < from_high ? low.at.state : high.at.state);
      if (!next || !std::isfinite(next->step.stiffness)) return {};
      if (std::min(from_low, from_high) <= limit_accuracy) return next->step;
      const bool is_low = (next->step.stiffness > 0) == (low.load > 0);
      replace(is_low ? low : high, is_low ? high : low, *next, next->step.stiffness);
    }
    return {};
  }

  /// Finds the summit of the energy by regula falsi with the Illinois rule.
  EnergyBarrier of(const EnergyTurn& turn) {
    Side low{turn.before, turn.before.step.load}, high{turn.after, turn.after.step.load};
    const double scale = std::max(std::abs(low.load), std::abs(high.load));
    EnergyBarrier best = barrier(low.at.step.kept_energy() > high.at.step.kept_energy() ? low.at : high.at);
    if (!system_.elastic.drive().is_external() || (low.load > 0) == (high.load > 0)) return best;
    for (int k = 0; k < max_equilibria; ++k) {
      const double theta = (low.theta() * high.load - high.theta() * low.load) / (high.load - low.load);
      const double from_low = std::abs(theta - low.theta()), from_high = std::abs(theta - high.theta());
      const auto next = equilibrium(theta, from_low < from_high ? low.at.state : high.at.state);
      if (!next) return best;
      if (next->step.energy > best.energy) best = barrier(*next);
      if (std::min(from_low, from_high) <= theta_accuracy) {
        best.load_vanishes = std::abs(next->step.load) <= vanishing * scale;
        return best;
      }
      const bool is_low = (next->step.load > 0) == (low.load > 0);
      replace(is_low ? low : high, is_low ? high : low, *next, next->step.load);
    }
    return best;
  }

 private:
  struct Side {
    DrivenState at;
    double load;        ///< or other quantity that must vanish
    bool kept = false;  ///< the other side moved last
    double theta() const { return at.step.theta; }
  };

  static void replace(Side& side, Side& other, DrivenState next, double load) {
    if (other.kept) other.load /= 2;
    other.kept = true;
    side = {std::move(next), load, false};
  }

  EnergyBarrier barrier(const DrivenState& at) const {
    const double theta = mean_theta(system_.elastic.structure(), at.state);
    return {0, 0, at.step.kept_energy(), theta, at.step.drive, false};
  }

  std::optional<DrivenState> equilibrium(double theta, State state) {
    system_.elastic.place(theta, state);
    const NewtonResult newton = minimise(system_.elastic, theta, newton_, state, system_.tangent);
    if (!newton.converged) return {};
    const EquilibriumStep step = system_.measured(state, theta, newton.stable);
    return DrivenState{step, std::move(state)};
  }

  MeasuredSystem system_;
  const NewtonOptions& newton_;
};

using Loads = std::vector<double>;

bool is_peak(const Loads& loads, std::size_t k) {
  return loads[k] > loads[k - 1] && loads[k] >= loads[k + 1];
}

/// Returns how far the load falls from `begin` on, before it exceeds `from` or ends.
template <class Iterator>
double fall(double from, Iterator begin, Iterator end) {
  double lowest = from;
  for (auto it = begin; it != end && *it <= from; ++it) lowest = std::min(lowest, *it);
  return from - lowest;
}

double prominence_of(const Loads& loads, std::size_t k) {
  const auto after = loads.begin() + static_cast<std::ptrdiff_t>(k) + 1;
  const auto before = loads.rbegin() + static_cast<std::ptrdiff_t>(loads.size() - k);
  return std::min(fall(loads[k], after, loads.end()), fall(loads[k], before, loads.rend()));
}

/// Returns the signed loads. If plates that press have released bodies, the last state is omitted: the others
/// have plates that grip.
Loads signed_loads(const EquilibriumPath& path, double sign) {
  Loads loads;
  for (const EquilibriumStep& step : path.steps) loads.push_back(sign * step.load);
  if (path.let_go > 0) loads.pop_back();
  return loads;
}

/// Returns whether a load, times `sign`, is a prominent maximum among those of the path up to the next larger
/// one.
bool is_distinct(const std::vector<EquilibriumStep>& steps, std::size_t place, double load, double sign) {
  double largest = std::abs(load), lowest_before = sign * load, lowest_behind = sign * load;
  for (std::size_t k = 0; k < place; ++k) largest = std::max(largest, std::abs(steps[k].load));
  for (std::size_t k = place; k-- > 0 && sign * steps[k].load <= sign * load;)
    lowest_before = std::min(lowest_before, sign * steps[k].load);
  std::size_t k = place;
  for (; k < steps.size() && sign * steps[k].load <= sign * load; ++k)
    lowest_behind = std::min(lowest_behind, sign * steps[k].load);
  const double least = prominent * largest;
  return sign * load - lowest_before >= least &&
         (k == steps.size() ? sign * load > lowest_behind : sign * load - lowest_behind >= least);
}

}  // namespace

void LoadTurns::see(const EquilibriumStep& step, const State& state) {
  DrivenState now{step, state};
  if (last_.step.stiffness * step.stiffness < 0) turns_.push_back({std::move(last_), now});
  last_ = std::move(now);
}

std::vector<PathEvent> located_limit_points(const Linkage& structure, const Elasticity& elasticity,
                                            const LinkageDrive& drive, const EquilibriumPathOptions& options,
                                            const LoadTurns& turns, const EquilibriumPath& path) {
  std::vector<PathEvent> found;
  if (turns.turns().empty()) return found;
  std::vector<EquilibriumStep> steps = path.steps;
  if (path.let_go > 0) steps.pop_back();  // its plates hold other rows
  Summit search(structure, elasticity, drive, options);
  for (const LoadTurns::Turn& turn : turns.turns()) {
    const double before = turn.before.step.theta, after = turn.after.step.theta;
    const bool jumps = std::any_of(path.events.begin(), path.events.end(), [&](const PathEvent& event) {
      return event.since == before &&
             (event.kind == PathEvent::Kind::snap || event.kind == PathEvent::Kind::bifurcation);
    });
    const auto limit = jumps ? std::nullopt : search.limit(turn);
    if (!limit) continue;
    const bool maximum = turn.before.step.stiffness * (turn.after.step.drive - turn.before.step.drive) > 0;
    const auto place = std::find_if(steps.begin(), steps.end(), [&](const EquilibriumStep& step) {
      return std::abs(step.theta) >= std::abs(after);
    });
    if (is_distinct(steps, static_cast<std::size_t>(place - steps.begin()), limit->load, maximum ? 1 : -1))
      found.push_back({PathEvent::Kind::limit_point, *limit, before,
                       maximum ? "the load reached a maximum" : "the load reached a minimum"});
  }
  return found;
}

void EnergyTurns::see(const EquilibriumStep& step, const State& state) {
  DrivenState now{step, state};
  if (std::exchange(started_, true)) {
    const double change = step.kept_energy() - last_.step.kept_energy();
    const double slope = drive_.is_external() ? step.load * (step.drive - last_.step.drive) : change;
    const bool fell = change < 0;
    if (slope_ > 0 && (slope < 0 || fell)) turns_.push_back({true, last_, now});
    if (slope > 0 && (slope_ < 0 || (slope_ > 0 && fell))) turns_.push_back({false, last_, now});
    slope_ = slope;
  }
  last_ = std::move(now);
}

EnergyBarrier energy_summit(const Linkage& structure, const Elasticity& elasticity, const LinkageDrive& drive,
                            const EquilibriumPathOptions& options, const EnergyTurn& turn) {
  return Summit(structure, elasticity, drive, options).of(turn);
}

std::vector<PathEvent> limit_points(const EquilibriumPath& path, double prominence) {
  const Loads loads = signed_loads(path, 1), mirrored = signed_loads(path, -1);
  const auto [low, high] = std::minmax_element(loads.begin(), loads.end());
  std::vector<PathEvent> found;
  for (std::size_t k = 1; k + 1 < loads.size(); ++k)
    for (const Loads* side : {&loads, &mirrored})
      if (is_peak(*side, k) && prominence_of(*side, k) >= prominence * (*high - *low))
        found.push_back({PathEvent::Kind::limit_point, path.steps[k], path.steps[k - 1].theta,
                         side == &loads ? "the load reached a maximum" : "the load reached a minimum"});
  return found;
}

void add_limit_points(EquilibriumPath& path) { add_limit_points(path, limit_points(path)); }

void add_limit_points(EquilibriumPath& path, const std::vector<PathEvent>& limits) {
  path.events.insert(path.events.end(), limits.begin(), limits.end());
  std::stable_sort(path.events.begin(), path.events.end(), [](const PathEvent& a, const PathEvent& b) {
    return std::abs(a.at.theta) < std::abs(b.at.theta);
  });
}

}  // namespace kinetix::model
