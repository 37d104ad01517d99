#pragma once

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/base/progress.hpp"
#include "optim/display/fit_display.hpp"

namespace kinetix::app {

/// Returns the plates of a file; for a search over plates, those at its start. The plates grip the panel.
model::Plates plates_of(const DisplayFile& file);

/// Returns the options of a search with hinges on their walls.
optim::DisplayOptions search_options(const DisplayFile& file, const model::Elasticity& elasticity,
                                     const RunOptions& run);

/// Runs the search of a file: by scaling of walls if hinges may have offsets, else by stretching.
/// @param panel has the goal's cells   @param progress receives words and the share done
optim::DisplayDesign search_panel(const DisplayFile& file, const model::Lattice& panel,
                                  const optim::DisplayOptions& options, const Progress& progress);

/// Strains a panel found by scaling of walls within the file's stretch limit (optim::refine_display).
void refine_panel(const DisplayFile& file, const targets::DisplayGoal& goal, const model::Lattice& panel,
                  optim::DisplayOptions options, optim::DisplayDesign& design, const Progress& progress);

/// Moves the hinges of a panel to the positions that a search found.
void place_hinges(const optim::DisplayView& view, model::Lattice& panel);

/// Reads a state of the file's panel by its channel.
DisplayReading read_panel(const DisplayFile& file, const model::Lattice& panel, const model::State& state);
/// Reads a state for the report: also its light and the distinguishable parts of letters.
DisplayReading read_shown_panel(const DisplayFile& file, const model::Lattice& panel,
                                const model::State& state);
/// Returns the drive of a search result: the driven hinge if there is one, else the plates.
model::Drive drive_of(const optim::DisplayView& view);

/// Makes the flat panel of a file with this many cells. All hinges are basic.
model::Lattice make_panel(const DisplayFile& file, targets::PanelSize size);

/// Returns the file with compression and angle scaled by `share`, (0, 1], and without a search range for compression.
/// @param share 1: the file is returned unchanged
DisplayFile pressed_by(DisplayFile file, double share);

/// Computes force and strain of a panel along its equilibrium path from flat, and the reading of its last state.
PanelLoads panel_loads(const DisplayFile& file, const model::Lattice& panel, optim::DisplayView view,
                       const model::Elasticity& elasticity);

/// Reduces the compression until the panel stays within the file's limits. The loads without limits are kept in
/// `unlimited`.
///
/// The search ends at a hundredth of the compression, or when an eye cannot distinguish letter and rest. If the limits
/// are still exceeded, the panel stays as it was and least_pressed is set.
/// @param search finds the design for a compression   @param stop results after a stop are discarded
void keep_limits(const DisplayFile& file, const model::Elasticity& elasticity, DisplayOutcome& display,
                 model::Lattice& panel, const std::function<optim::DisplayDesign(const DisplayFile&)>& search,
                 const std::stop_token& stop = {});

/// Analyses print tolerances of the panel in its equilibrium: to first order, and with sampled prints that are solved
/// for their equilibrium.
/// @return the analysis, or nullopt with the reason: a grey picture, a large panel or no stable equilibrium
std::pair<std::optional<PrintedDisplay>, std::string> display_prints(const DisplayFile& file, const Run& run,
                                                                     const RunOptions& options);

}  // namespace kinetix::app
