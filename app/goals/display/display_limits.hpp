#pragma once

#include <functional>
#include <stop_token>

#include "app/goals/display/display_file.hpp"
#include "app/goals/display/display_outcome.hpp"

namespace kinetix::app {

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

}  // namespace kinetix::app
