#pragma once

#include <optional>

#include "model/elastic/path/measured_system.hpp"

namespace kinetix::model {

/// Goes back along a path in small steps, to see whether a step of it was reversible.
class Retrace {
 public:
  enum class Finding {
    reversible,  ///< back in the state before, or in one of the same energy
    lossy,       ///< in another state of other energy: a snap
    mirrored,    ///< in the state before, folded to the other side
    unknown,     ///< no equilibrium was found on the way back
  };

  /// All parameters are kept by reference.
  Retrace(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options)
      : driven_(driven), elasticity_(elasticity), options_(options) {}

  /// A state of equilibrium at a theta, rad, with the multiplier of its drive.
  struct Place {
    const State& state;
    double theta = 0;
    double multiplier = 0;
  };
  Finding back(const Place& after, const Place& before);

 private:
  /// At theta, from a state nearby. @return whether it is stable
  bool settle(double theta, State& state);

  const DrivenLinkage& driven_;
  const Elasticity& elasticity_;
  const EquilibriumPathOptions& options_;
  std::optional<MeasuredSystem> system_;  ///< beside that of the path, which stays as it is
};

}  // namespace kinetix::model
