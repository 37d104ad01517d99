#pragma once

#include "model/elastic/path/equilibrium_path.hpp"

/// Turning points of an equilibrium path: of its energy, where the drive's load changes sign, and of its
/// load.
namespace kinetix::model {

/// Equilibrium on a driven path.
struct DrivenState {
  EquilibriumStep step;
  State state;
};

/// Two consecutive states between which the energy of a driven path turns from rising to falling, or back. A
/// jump down between two states with rising energy counts as one of each.
struct EnergyTurn {
  bool maximum = false;
  DrivenState before, after;
};

/// Energy turns and end of a path, for a search for stable states. Pass see() to trace_equilibrium() as
/// `frame`. The slope is computed from the load, so that no turn is missed between two states. Shape-memory
/// springs do not hold a state after they cool. For these drives only the energy of hinges and contacts
/// counts, with its slope between two states.
class EnergyTurns {
 public:
  explicit EnergyTurns(const LinkageDrive& drive) : drive_(drive) {}

  void see(const EquilibriumStep& step, const State& state);

  const LinkageDrive& drive() const { return drive_; }
  const std::vector<EnergyTurn>& turns() const { return turns_; }
  /// Last state seen. @pre a state was seen
  const DrivenState& last() const { return last_; }
  /// Returns whether the energy still falls at the end.
  bool ends_descending() const { return slope_ < 0; }
  /// State at which the energy stops falling if the drive continues beyond the end, if known.
  const std::optional<DrivenState>& foot() const { return foot_; }
  void set_foot(DrivenState foot) { foot_ = std::move(foot); }

 private:
  LinkageDrive drive_;
  std::vector<EnergyTurn> turns_;
  DrivenState last_;
  std::optional<DrivenState> foot_;
  bool started_ = false;
  double slope_ = 0;  ///< sign of the energy's change along the path at its end
};

/// Energy barrier between two stable states: the largest energy on the driven path from one to the other.
struct EnergyBarrier {
  int from = 0, to = 0;  ///< indices in StableStates::states, from < to
  double energy = 0;     ///< N mm
  double theta = 0;      ///< of the sheet there, as in StableState, rad
  double drive = 0;      ///< the drive's coordinate there, as in EquilibriumStep: fraction, mm or rad
  /// Whether the drive's load vanishes there (for a driven hinge, a saddle of the energy). Otherwise the path
  /// jumped down from there.
  bool load_vanishes = false;
};

/// Finds the summit of an energy maximum on the path of `drive`. It is where the load vanishes, to 1e-7 rad
/// of theta, found from equilibria between the turn's two states. For shape memory it is the turn's state
/// with more energy of hinges and contacts. The result's `from` and `to` are not set.
/// @pre turn.maximum; structure, elasticity, drive and options those of the path
EnergyBarrier energy_summit(const Linkage& structure, const Elasticity& elasticity, const LinkageDrive& drive,
                            const EquilibriumPathOptions& options, const EnergyTurn& turn);

/// Consecutive states of a path between which its load turns from rising with the drive to falling, or back.
/// Pass see() to trace_equilibrium() as `frame`.
class LoadTurns {
 public:
  struct Turn {
    DrivenState before, after;
  };

  void see(const EquilibriumStep& step, const State& state);
  const std::vector<Turn>& turns() const { return turns_; }

 private:
  std::vector<Turn> turns_;
  DrivenState last_;
};

/// Locates limit points of the load to 1e-8 rad of theta between two states of the path. Returns them as
/// events in the order of the path. A maximum is prominent if the load rises to it by at least 2 % of the
/// largest load so far. After it, the load must fall by as much before it exceeds the maximum. If the path
/// ends first, any fall is sufficient. Minima follow the same rule.
/// @pre structure, elasticity, drive and options those of the path
std::vector<PathEvent> located_limit_points(const Linkage& structure, const Elasticity& elasticity,
                                            const LinkageDrive& drive, const EquilibriumPathOptions& options,
                                            const LoadTurns& turns, const EquilibriumPath& path);

/// Finds the steps at which the load of a path has a maximum or a minimum, as events in the order of the
/// path, without the ends. On both sides of a maximum the load must fall by at least `prominence` times the
/// span of all loads, before it rises above the maximum. Minima follow the same rule. The last state is
/// ignored if plates have released bodies there.
std::vector<PathEvent> limit_points(const EquilibriumPath& path, double prominence = 0.02);

/// Adds limit points to the path's events and keeps these in the order of the path.
void add_limit_points(EquilibriumPath& path, const std::vector<PathEvent>& limits);
void add_limit_points(EquilibriumPath& path);

}  // namespace kinetix::model
