#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Returns how many sample prints to solve for equilibrium: as many as the run requests, and at least 20. First order
/// may be far off where cells that do not close bulge. Twenty prints show that in a fraction of a second.
int prints_of(const RunOptions& options);
/// Returns the options of a print analysis: threads and stop token of the run.
/// @param planar prints move in the plane z = 0 only   @param options are kept by reference
model::ToleranceOptions print_options(const RunOptions& options, bool planar);

/// Returns the scatter of each hinge: errors of the design's process, and the clearance of pins
/// (model::clearance_scatter).
model::HingeScatter scatter_of(const Design& design);
/// Returns the sheet with these errors added to its hinges (model::PrintedLinkage).
model::Lattice printed_sheet(model::Lattice sheet, const Eigen::Matrix4Xd& errors);

/// Computes the print tolerance to first order, as as_made() does, without sample prints. Empty without points, or if
/// no stable equilibrium is near the design.
std::optional<PrintedGoal> estimate_print_tolerance(const SearchResult& found,
                                                    const model::LinkageDrive& drive,
                                                    const model::State& design,
                                                    const std::vector<model::ObservedPoint>& points);

/// Computes the print tolerance of a state of the run. Prints have hinges as print_hinges() gives them and the errors
/// of scatter_of(): place of hinges, tilt of walls, and what a pin's clearance leaves open.
/// @param drive holds the state, in equilibrium or nearly so.   @param points by which the goal is judged.
/// @param options number of sample prints that are solved for equilibrium to confirm the result (prints_of). Large
/// sheets have none unless requested. A stop request ends the analysis.
/// @return empty without points, or if no stable equilibrium under that drive is near the state
std::optional<PrintedGoal> analyse_print_tolerance(const Run& run, const model::LinkageDrive& drive,
                                                   const model::State& state,
                                                   const std::vector<model::ObservedPoint>& points,
                                                   const RunOptions& options);

/// Hinges and drive with which prints of a run are judged.
struct PrintHinges {
  model::Elasticity elasticity;
  model::LinkageDrive drive;       ///< holds the prints
  std::optional<SoftHinges> soft;  ///< of a design whose hinges turn freely; empty if all are pins
};

/// Returns the hinges of prints of a design. Elastic hinges are the file's, under the drive that holds the design.
/// Hinges that turn freely have no drive in prints: each was set at its turn in the design and keeps it
/// (model::SetHinge). It is manufactured as the file says. If the file leaves that open, it is
/// an assumed soft block of the run's process, as long as the largest turn needs.
/// @param drive holds the design   @param design its state, exact if hinges turn freely
PrintHinges print_hinges(const SearchResult& found, const model::LinkageDrive& drive,
                         const model::State& design);

/// Returns the hinges with each at rest at its turn in a state of the sheet, as if it had been set there.
model::Elasticity with_rest_at(model::Elasticity elasticity, const model::Linkage& linkage,
                               const model::State& state);

}  // namespace kinetix::app
