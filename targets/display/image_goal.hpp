#pragma once

#include <optional>
#include <string>

#include "targets/display/display_goal.hpp"
#include "targets/display/image_file.hpp"

namespace kinetix::targets {

/// Cells across: enough for a simple drawing; more cost the search time and memory.
inline constexpr int default_image_columns = 20;

/// The whole image on the whole panel, each side scaled by itself, without a margin: a cell's level is the
/// ink of its area, and with two levels it is letter where ink covers at least half of it.
/// Where that loses strokes of an image of two levels, `needed` of the goal names the smallest larger panel
/// that keeps them (whole_picture.hpp).
/// @param size nothing: 20 columns, and the rows that keep the image's proportions
/// @param cell_shape distance of neighbouring columns over that of neighbouring rows
/// @throws InvalidInput for what read_image and make_goal refuse
DisplayGoal image_goal(const std::string& file, std::optional<PanelSize> size = {},
                       ImageLevels levels = ImageLevels::two, bool invert = false, double cell_shape = 1);

}  // namespace kinetix::targets
