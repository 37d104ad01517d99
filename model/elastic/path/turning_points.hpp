#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "model/elastic/path/equilibrium_path.hpp"

/// Turning points of an equilibrium path: of its energy, where the drive's load changes sign, and of its
/// load.
namespace kinetix::model {

/// An equilibrium on a driven path.
struct DrivenState {
  EquilibriumStep step;
  State state;
};

/// Two states in a row between which the energy of a driven path turns: from rising to falling, or back. A
/// jump down between two states with rising energy is one of each.
struct EnergyTurn {
  bool maximum = false;
  DrivenState before, after;
};

/// What a search for stable states keeps of a path: where its energy turns, and its end. Give see() to
/// trace_equilibrium as `frame`; the slope comes from the load, so that no turn hides between two states. Springs of shape
/// memory are no part of what keeps a state once they are cold: of these drives the energy of hinges and contacts alone
/// counts, and its slope is that between two states.
class EnergyTurns {
 public:
  explicit EnergyTurns(const LinkageDrive& drive) : drive_(drive) {}

  void see(const EquilibriumStep& step, const State& state);

  const LinkageDrive& drive() const { return drive_; }
  const std::vector<EnergyTurn>& turns() const { return turns_; }
  /// @pre a state was seen
  const DrivenState& last() const { return last_; }
  /// Whether the energy still falls at the end.
  bool ends_falling() const { return slope_ < 0; }
  /// Where it stops falling if the drive goes on beyond the end, if that is known.
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

/// What keeps two stable states apart: the largest energy on the driven path from one to the other.
struct EnergyBarrier {
  int from = 0, to = 0;  ///< in StableStates::states, from < to
  double energy = 0;     ///< N mm
  double theta = 0;      ///< of the sheet there, as of a StableState, rad
  double drive = 0;      ///< the drive's coordinate there, as in EquilibriumStep: fraction, mm or rad
  /// Whether the drive's load vanishes there (with a driven hinge, a saddle of the energy); otherwise the
  /// path jumped down from there.
  bool load_vanishes = false;
};

/// The top of a maximum on the path of `drive`; of shape memory, in the energy of hinges and contacts, the higher one of the
/// turn's two states. Else: where its load vanishes, within 1e-7 rad of theta, found from
/// equilibria between the turn's two states. `from` and `to` are left open.
/// @pre turn.maximum; structure, elasticity, drive and options those of the path
EnergyBarrier energy_summit(const Linkage& structure, const Elasticity& elasticity, const LinkageDrive& drive,
                            const EquilibriumPathOptions& options, const EnergyTurn& turn);

/// Keeps of a path the states in a row between which its load turns: from rising with the drive to falling, or back. Give see()
/// to trace_equilibrium as `frame`.
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

/// Limit points of the load, each located to 1e-8 rad of theta between two states of the path, as events in the order of the
/// path. A maximum stands out where the load has risen to it by at least 2 % of the largest load up to there, and falls behind
/// it by as much before it rises above it again or the path ends; a minimum likewise.
/// @pre structure, elasticity, drive and options those of the path
std::vector<PathEvent> located_limit_points(const Linkage& structure, const Elasticity& elasticity,
                                            const LinkageDrive& drive, const EquilibriumPathOptions& options,
                                            const LoadTurns& turns, const EquilibriumPath& path);

/// The steps of a path at which its load has a maximum or a minimum, as events in the order of the path; the
/// ends do not count. A maximum stands out where the load falls on both sides of it, before it rises above it
/// again, by at least `prominence` times the span of all loads; a minimum likewise. Plates that let go at the end make none.
std::vector<PathEvent> limit_points(const EquilibriumPath& path, double prominence = 0.02);

/// Adds limit points to the path's events, which stay in the order of the path.
void add_limit_points(EquilibriumPath& path, const std::vector<PathEvent>& limits);
void add_limit_points(EquilibriumPath& path);

}  // namespace kinetix::model
