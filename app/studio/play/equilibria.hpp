#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/studio/play/shape.hpp"
#include "model/elastic/path/stable_states.hpp"

namespace kinetix::app::studio {

/// Equilibria of a design under its own drive, or else the usual one, from flat on: what is known of its way.
struct KnownWay {
  std::vector<model::DrivenState> states;  ///< theta, that of the drive, grows in size
  model::EnergyTurns turns;
};

/// Elastic hinges of a design whose hinges may be rigid, under the drive to one theta after the other.
class Equilibria {
 public:
  using Seen = std::function<void(const model::DrivenState& at)>;

  /// @param design theta counts alone as the side that it folds to   @param moving of it; bodies have their parts
  Equilibria(Design design, Moving moving);

  /// Goes to theta, rad: from the nearest state of the way that is known, else from flat. `seen` hears of every state on
  /// the way, the last one included.
  /// @param way null: nothing is known   @param why in words where it does not come to theta; else empty
  /// @return what is known then: as far as theta at least, unless the way ends before
  std::shared_ptr<const KnownWay> go(double theta, const std::shared_ptr<const KnownWay>& way,
                                     const std::stop_token& stop, const Seen& seen, std::string& why) const;

  /// Where the structure goes when it is let go along the way.
  std::vector<model::StableState> stable(const KnownWay& way, const std::stop_token& stop) const;

  /// Load as a force from outside, N: a moment by the lever of a cell edge; 0 of springs, which need nobody.
  double force_N(double theta, double load) const;

 private:
  model::LinkageDrive drive(double theta) const;
  model::EquilibriumPathOptions options(const std::stop_token& stop) const;
  bool follow(model::DrivenState& at, double theta, const std::stop_token& stop) const;
  std::shared_ptr<KnownWay> from_flat(double theta, const std::stop_token& stop, const Seen& seen,
                                      std::string& why) const;

  Design design_;
  Moving moving_;
  model::Elasticity elasticity_;
};

}  // namespace kinetix::app::studio
