#include "model/elastic/path/stable_states.hpp"

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/elastic/lowest_mode.hpp"

namespace kinetix::model {
namespace {

using Eigen::VectorXd;

constexpr double different = 1e-3;  // rad of a hinge: releases that end closer found the same state
constexpr double furthest = 1.55;   // rad of theta: no drive goes to a right angle
constexpr int most_left = 5;        // saddles in a row after a release: with more it is unresolved
// Rad, cell edges: enough to leave the saddle, too little to reach another valley.
constexpr double off_saddle = 1e-2;

std::string released_at(const EquilibriumStep& step) {
  return "released at a fold angle of " + number_text(std::round(10 * to_degrees(step.theta)) / 10) +
         " deg of the drive";
}

/// Structure without a drive.
class Release {
 public:
  Release(const Linkage& structure, const Elasticity& elasticity, const StableStateOptions& options)
      : system_(structure, elasticity, options.path.planar.value_or(all_vertical(structure)),
                options.path.contact, options.path.bodies),
        tangent_(system_.dofs()),
        newton_(options.path.newton),
        unit_(energy_unit(elasticity, structure.size.edge_mm)) {
    newton_.max_iterations = options.max_iterations;
  }

  /// Releases the structure. @return its state of rest; empty if there is none, with the reason in `why`
  std::optional<StableState> from(const DrivenState& start, std::string& why) {
    State state = start.state;
    NewtonResult result = minimise(system_, 0, newton_, state, tangent_);
    for (int k = 0; k < most_left && result.converged && !result.stable && leave(state); ++k)
      result = minimise(system_, 0, newton_, state, tangent_);
    if (!result.converged || !result.stable) {
      why = released_at(start.step) + ": no stable state after " + std::to_string(result.iterations) +
            " iterations, force " + number_text(result.force) + " left";
      return {};
    }
    if (system_.newly_cross(start.state, state)) {
      why = released_at(start.step) + ": walls would have to pass through each other";
      return {};
    }
    return described(std::move(state), released_at(start.step));
  }

  StableState described(State state, std::string how) const {
    const Linkage& structure = system_.structure();
    StableState found;
    found.energy = system_.elastic_energy(state) * unit_;
    found.theta = mean_theta(structure, state);
    found.gaps = hinge_gaps(structure, state);
    found.state = std::move(state);
    found.how = std::move(how);
    return found;
  }

 private:
  bool leave(State& state) {
    const LowestMode mode = lowest_mode(tangent_);
    if (!mode.converged || !(mode.value < 0)) return false;
    const VectorXd along = system_.dofs().extend(mode.direction);
    state = system_.retract(state, off_saddle / system_.length(state, along) * along);
    return true;
  }

  ElasticSystem system_;
  TangentStiffness tangent_;
  NewtonOptions newton_;
  double unit_;
};

const DrivenState& lower(const EnergyTurn& turn) {
  return turn.before.step.kept_energy() < turn.after.step.kept_energy() ? turn.before : turn.after;
}

/// Collector of the stable states along all paths.
class Collector {
 public:
  Collector(const Linkage& structure, const Elasticity& elasticity, const StableStateOptions& options)
      : structure_(structure),
        elasticity_(elasticity),
        path_options_(options.path),
        release_(structure, elasticity, options) {
    found_.states.push_back(release_.described(rest_state(structure), "flat"));
  }

  void add(const EnergyTurns& path) {
    int at = 0;
    std::optional<EnergyTurn> top;
    const auto arrive = [&](const DrivenState& start) {
      const int next = settle(start);
      if (next >= 0 && next != at && top) add_barrier(path.drive(), *top, at, next);
      if (next >= 0) at = next;
      top.reset();
    };
    for (const EnergyTurn& turn : path.turns()) {
      if (path_options_.stop.stop_requested()) return;
      if (!turn.maximum)
        arrive(lower(turn));
      else if (!top || turn.before.step.kept_energy() > top->before.step.kept_energy())
        top = turn;
    }
    if (path.ends_descending() && !path_options_.stop.stop_requested())
      arrive({path.last().step, path.foot() ? path.foot()->state : path.last().state});
  }

  StableStates found() { return std::move(found_); }

 private:
  /// Returns the index of the state that a release leads to, new or known; -1 if it leads to none.
  int settle(const DrivenState& start) {
    std::string why;
    auto state = release_.from(start, why);
    if (!state) {
      found_.unresolved.push_back(why);
      return -1;
    }
    const auto same = std::find_if(found_.states.begin(), found_.states.end(), [&](const StableState& known) {
      return turn_distance(structure_, known.state, state->state) <= different;
    });
    const auto index = same - found_.states.begin();
    if (same == found_.states.end()) found_.states.push_back(std::move(*state));
    return static_cast<int>(index);
  }

  void add_barrier(const LinkageDrive& drive, const EnergyTurn& top, int from, int to) {
    EnergyBarrier barrier = energy_summit(structure_, elasticity_, drive, path_options_, top);
    barrier.from = std::min(from, to);
    barrier.to = std::max(from, to);
    const auto known =
        std::find_if(found_.barriers.begin(), found_.barriers.end(),
                     [&](const EnergyBarrier& b) { return b.from == barrier.from && b.to == barrier.to; });
    if (known == found_.barriers.end())
      found_.barriers.push_back(barrier);
    else if (barrier.energy < known->energy)
      *known = barrier;
  }

  const Linkage& structure_;
  const Elasticity& elasticity_;
  const EquilibriumPathOptions& path_options_;
  Release release_;
  StableStates found_;
};

}  // namespace

void follow_descent(const DrivenLinkage& driven, const Elasticity& elasticity,
                    const EquilibriumPathOptions& options, EnergyTurns& path) {
  const double goal = driven.drive.theta();
  const bool came_there = path.ends_descending() && path.last().step.theta == goal;
  if (!came_there || driven.drive.press || !driven.drive.is_external() || std::abs(goal) >= furthest) return;
  const DrivenLinkage further{driven.linkage, driven.drive.to(std::copysign(furthest, goal)), driven.exact};
  EnergyTurns longer(further.drive);
  std::stop_source found;
  EquilibriumPathOptions same = options;
  same.stop = found.get_token();
  trace_equilibrium(further, elasticity, same, [&](const EquilibriumStep& step, const State& state) {
    longer.see(step, state);
    const bool has_fallen = std::abs(step.theta) > std::abs(goal) && !longer.ends_descending();
    if (has_fallen || options.stop.stop_requested()) found.request_stop();
  });
  if (options.stop.stop_requested()) return;
  const auto foot = std::find_if(longer.turns().begin(), longer.turns().end(), [&](const EnergyTurn& turn) {
    return !turn.maximum && std::abs(turn.after.step.theta) > std::abs(goal);
  });
  path.set_foot(foot != longer.turns().end() ? lower(*foot) : longer.last());
}

StableStates stable_states(const Linkage& structure, const Elasticity& elasticity,
                           const std::vector<EnergyTurns>& paths, const StableStateOptions& options) {
  Collector collector(structure, elasticity, options);
  for (const EnergyTurns& path : paths) collector.add(path);
  return collector.found();
}

StableStates find_stable_states(const std::vector<DrivenLinkage>& drives, const Elasticity& elasticity,
                                const StableStateOptions& options) {
  std::vector<EnergyTurns> paths;
  for (const DrivenLinkage& driven : drives) {
    EnergyTurns& path = paths.emplace_back(driven.drive);
    trace_equilibrium(driven, elasticity, options.path,
                      [&](const EquilibriumStep& step, const State& state) { path.see(step, state); });
    follow_descent(driven, elasticity, options.path, path);
  }
  return stable_states(drives.front().linkage, elasticity, paths, options);
}

}  // namespace kinetix::model
