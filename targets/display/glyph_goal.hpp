#pragma once

#include <string>

#include "targets/display/display_goal.hpp"
#include "targets/display/font_file.hpp"

namespace kinetix::targets {

/// Most characters of a text: a short word. At the default of 10 columns per character the panel is 120 cells wide.
inline constexpr int max_glyph_characters = 12;
/// Least cells on the shorter side of a panel with a margin; the margin is one cell around the letter. On fewer cells
/// a margin would leave the letter less than three, too few for its strokes and gaps.
inline constexpr int least_side_with_margin = 5;
/// Largest stretch of a letter in width or height, a factor. Less wastes cells; more spoils the letter's look.
inline constexpr double max_glyph_stretch = 1.5;

/// Draws a letter or a short word on a panel, binary: a cell is letter if ink covers at least half of it.
///
/// The ink is scaled to the panel less its margin, in its proportions, until the tighter side is full. Then it is
/// stretched along the other side, by at most 1.5, until that is full too, and centred. Strokes are thus as wide as
/// the panel allows for a letter that keeps its look. If strokes are still thinner than a cell, only a larger panel
/// helps.
///
/// If strokes are lost, `needed` of the goal names the smallest larger panel that keeps them (whole_picture.hpp).
/// @param text UTF-8, 1 to 12 characters.
/// @param cell_shape distance of neighbouring columns over that of neighbouring rows.
/// @throws InvalidInput for another number of characters, and for what glyph_picture and make_goal refuse. The message
/// names a larger panel if one helps.
DisplayGoal glyph_goal(const std::string& text, const FontFile& font, int columns, int rows,
                       double cell_shape = 1);

/// Uses the first of fonts_by_default whose strokes the panel keeps, else the last of them.
DisplayGoal glyph_goal(const std::string& text, int columns, int rows, double cell_shape = 1);

}  // namespace kinetix::targets
