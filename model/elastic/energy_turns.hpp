#pragma once

#include <vector>

#include "model/elastic/equilibrium_path.hpp"
#include "model/linkage/linkage_drive.hpp"

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
/// trace_equilibrium as `frame`; the slope comes from the load, so that no turn hides between two states.
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

 private:
  LinkageDrive drive_;
  std::vector<EnergyTurn> turns_;
  DrivenState last_;
  bool started_ = false;
  double slope_ = 0;  ///< sign of the energy's change along the path at its end
};

}  // namespace kinetix::model
