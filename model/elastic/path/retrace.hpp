#pragma once

#include <optional>

#include "model/elastic/path/measured_system.hpp"

namespace kinetix::model {

/// Test of whether a step of a path was reversible: follows the path backwards in small steps.
class Retrace {
 public:
  enum class Finding {
    reversible,  ///< back in the previous state, or in one of the same energy
    lossy,       ///< in another state of other energy: a snap-through
    mirrored,    ///< in the previous state, folded to the other side
    unknown,     ///< no equilibrium was found on the way back
  };

  /// All parameters are kept by reference.
  Retrace(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options)
      : driven_(driven), elasticity_(elasticity), options_(options) {}

  /// State in equilibrium at a theta, rad, with the multiplier of its drive.
  struct Place {
    const State& state;
    double theta = 0;
    double multiplier = 0;
  };
  Finding back(const Place& after, const Place& before);

 private:
  /// Settles a nearby state at theta. @return whether it is stable
  bool settle(double theta, State& state);

  const DrivenLinkage& driven_;
  const Elasticity& elasticity_;
  const EquilibriumPathOptions& options_;
  std::optional<MeasuredSystem> system_;  ///< separate from that of the path, which stays unchanged
};

}  // namespace kinetix::model
