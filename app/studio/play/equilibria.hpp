#pragma once

#include "app/studio/play/shape.hpp"
#include "model/elastic/path/stable_states.hpp"

namespace kinetix::app::studio {

/// Known equilibria of a design from flat on, under its drive, or the default drive if it has none.
struct KnownEquilibria {
  std::vector<model::DrivenState> states;  ///< sorted by increasing |theta| of the drive
  model::EnergyTurns turns;
};

/// Equilibria of a design with elastic hinges, even if its file has rigid ones, under a drive with changing
/// theta.
class Equilibria {
 public:
  using Seen = std::function<void(const model::DrivenState& at)>;

  /// @param design its theta gives only the side that it folds to   @param moving belongs to it; bodies have
  /// their parts
  Equilibria(Design design, Moving moving);

  /// Moves to theta, rad, from the nearest known state, or from flat. Calls `seen` for every state along the
  /// path, including the last.
  /// @param way null: nothing is known   @param why set to a sentence if theta is not reached; else empty.
  /// @return known equilibria after the call: up to theta, unless the equilibrium path ends before it
  std::shared_ptr<const KnownEquilibria> trace_to(double theta,
                                                  const std::shared_ptr<const KnownEquilibria>& known,
                                                  const std::stop_token& stop, const Seen& seen,
                                                  std::string& why) const;

  /// Finds the stable states that the structure reaches when it is released along the path.
  std::vector<model::StableState> stable(const KnownEquilibria& known, const std::stop_token& stop) const;

  /// Returns the load as an external force, N; a moment is divided by the cell edge. 0 for shape-memory
  /// springs.
  double force_N(double theta, double load) const;

 private:
  model::LinkageDrive drive(double theta) const;
  model::EquilibriumPathOptions options(const std::stop_token& stop) const;
  bool follow(model::DrivenState& at, double theta, const std::stop_token& stop) const;
  std::shared_ptr<KnownEquilibria> from_flat(double theta, const std::stop_token& stop, const Seen& seen,
                                             std::string& why) const;

  Design design_;
  Moving moving_;
  model::Elasticity elasticity_;
};

}  // namespace kinetix::app::studio
