#pragma once

#include <optional>
#include <string>

#include "targets/display/display_goal.hpp"
#include "targets/display/image_file.hpp"

namespace kinetix::targets {

/// Default columns: enough for a simple drawing. More cost the search time and memory.
inline constexpr int default_image_columns = 20;

/// Draws the whole image on the whole panel, each side scaled separately, without a margin. A cell's level is the ink
/// in its area; with two levels a cell is letter if ink covers at least half of it. If strokes of an image of two
/// levels are lost, `needed` of the goal names the smallest larger panel that keeps them (whole_picture.hpp).
/// @param size [columns, rows]; empty: 20 columns, and the rows that keep the image's proportions.
/// @param cell_shape distance of neighbouring columns over that of neighbouring rows.
/// @throws InvalidInput for what read_image and make_goal refuse
DisplayGoal image_goal(const std::string& file, std::optional<PanelSize> size = {},
                       ImageLevels levels = ImageLevels::two, bool invert = false, double cell_shape = 1);

}  // namespace kinetix::targets
