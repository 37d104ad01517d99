#pragma once

#include "app/run/run.hpp"

namespace kinetix::app {

/// What prints of a run are judged with.
struct PrintHinges {
  model::Elasticity elasticity;
  model::LinkageDrive drive;         ///< that holds them
  std::optional<TakenHinges> taken;  ///< where the file leaves open what hinges are
};

/// Elastic hinges as the file says, under the drive that holds the design. Where it asks for hinges that turn freely, prints
/// have hinges that were set at the turns of the design and keep them, without a drive (model::SetHinge): each as the file
/// makes it, else a soft block of the run's process, as long as the largest turn needs.
/// @param drive that holds the design   @param design its state, exact where hinges turn freely
PrintHinges print_hinges(const Found& found, const model::LinkageDrive& drive, const model::State& design);

/// The same hinges, each at rest at the turn that it has in a state of the sheet, as if it had been set there.
model::Elasticity set_in(model::Elasticity elasticity, const model::Linkage& linkage,
                         const model::State& state);

}  // namespace kinetix::app
