#pragma once

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"

namespace kinetix::app {

/// What a panel asks of who presses it and of its hinges.
PanelLoads panel_loads(const DisplayFile& file, const model::Sheet& panel, const optim::DisplayView& view,
                       const model::Elasticity& elasticity);

/// Presses the panel less, until it keeps the limits of the file, and keeps what it showed without them.
/// @param search finds the design for a compression
void keep_limits(const DisplayFile& file, const model::Elasticity& elasticity, DisplayOutcome& display,
                 model::Sheet& panel, const std::function<optim::DisplayDesign(const DisplayFile&)>& search);

}  // namespace kinetix::app
