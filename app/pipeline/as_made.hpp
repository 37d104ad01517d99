#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// How many prints are brought to their equilibrium: as many as the run asks for, and twenty in any case. What is true to
/// first order alone may be far off where cells that do not close bulge: enough to see that, and a fraction of a second of
/// work.
int prints_of(const RunOptions& options);
/// By the run's threads, until it is told to stop. @param planar prints move in the plane z = 0 only   @param options are
/// kept by reference
model::AsMadeOptions print_options(const RunOptions& options, bool planar);

/// What the run's process, and the play of its pins (model::play_scatter), do to each hinge.
model::HingeScatter scatter_of(const Design& design);
/// A sheet whose hinges are off by so much (model::PrintedLinkage).
model::Lattice printed_sheet(model::Lattice sheet, const Eigen::Matrix4Xd& errors);

/// What prints are expected to come to, to first order: as as_made(), without a print.
std::optional<PrintedGoal> expected_of_prints(const Found& found, const model::LinkageDrive& drive,
                                              const model::State& design,
                                              const std::vector<model::ObservedPoint>& points);

/// What prints of a state of the run's structure come to, with hinges as stiff as the file says (or by default) and the
/// process's errors: the place of hinges, the tilt of walls, and what a pin's clearance leaves open.
/// @param drive that holds the state, in equilibrium or nearly so   @param points by which the goal is judged
/// @param options how many prints are brought to their equilibrium as well, to confirm it; a few in any case, but for large
/// sheets, and until it is told to stop
/// @return nothing without points, or where the state is not stable under that drive
std::optional<PrintedGoal> as_made(const Run& run, const model::LinkageDrive& drive,
                                   const model::State& state, const std::vector<model::ObservedPoint>& points,
                                   const RunOptions& options);

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
