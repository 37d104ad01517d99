#pragma once

#include <string>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
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

}  // namespace kinetix::app
