#pragma once

#include <functional>
#include <stop_token>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"

namespace kinetix::app {

/// The same with a part of the drive's way, (0, 1], which is not searched then. @param share 1: as it is
DisplayFile pressed_by(DisplayFile file, double share);

/// What a panel asks of who presses it and of its hinges.
PanelLoads panel_loads(const DisplayFile& file, const model::Lattice& panel, optim::DisplayView view,
                       const model::Elasticity& elasticity);

/// Presses the panel less, until it keeps the limits of the file, and keeps what it showed without them. Down to a
/// hundredth of the way, and as far as an eye tells letter and rest apart; where that does not keep them, the panel stays
/// as it was and least_pressed says so.
/// @param search finds the design for a compression   @param stop what a search finds after it is not taken
void keep_limits(const DisplayFile& file, const model::Elasticity& elasticity, DisplayOutcome& display,
                 model::Lattice& panel, const std::function<optim::DisplayDesign(const DisplayFile&)>& search,
                 const std::stop_token& stop = {});

}  // namespace kinetix::app
