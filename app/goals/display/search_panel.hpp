#pragma once

#include <string>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/run/run_options.hpp"
#include "model/base/progress.hpp"
#include "optim/display/fit_display.hpp"

namespace kinetix::app {

/// The plates that a file asks for; where a search may change them, where it starts. Searches take them to grip.
model::Plates plates_of(const DisplayFile& file);

/// Of a search with hinges on their walls.
optim::DisplayOptions search_options(const DisplayFile& file, const model::Elasticity& elasticity,
                                     const RunOptions& run);

/// The search that a file asks for: by the scales of walls where hinges may have offsets, else by stretching.
/// @param panel of the goal's cells   @param progress words and the share done
optim::DisplayDesign search_panel(const DisplayFile& file, const model::Lattice& panel,
                                  const optim::DisplayOptions& options, const Progress& progress);

/// Strains a panel that was found by the scales of walls as far as the file allows (optim::refine_display).
void refine_panel(const DisplayFile& file, const targets::DisplayGoal& goal, const model::Lattice& panel,
                  optim::DisplayOptions options, optim::DisplayDesign& design, const Progress& progress);

/// Puts the hinges of a panel where a search left them.
void place_hinges(const optim::DisplayView& view, model::Lattice& panel);

/// Reads a state of the file's panel by its channel.
DisplayReading read_panel(const DisplayFile& file, const model::Lattice& panel, const model::State& state);
/// Reads a state that is reported: also its light, and which parts of letters can be told apart.
DisplayReading read_shown_panel(const DisplayFile& file, const model::Lattice& panel,
                                const model::State& state);
/// What moves a panel that was found, by its bodies and hinges.
model::Drive drive_of(const optim::DisplayView& view);

/// The flat panel of a file with this many cells, all hinges basic.
model::Lattice make_panel(const DisplayFile& file, targets::PanelSize size);

}  // namespace kinetix::app
