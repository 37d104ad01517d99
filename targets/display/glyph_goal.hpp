#pragma once

#include <string>

#include "targets/display/display_goal.hpp"
#include "targets/display/font_file.hpp"

namespace kinetix::targets {

/// Characters of a text: a short word. At the default of 10 columns for each the panel is 120 cells wide.
inline constexpr int max_glyph_characters = 12;
/// A panel whose shorter side has fewer cells than this has no margin around the letter; others have one
/// cell. With a margin, fewer would leave the letter less than three cells, too few for its strokes and gaps.
inline constexpr int least_side_with_margin = 5;
/// Times as drawn: how much wider or higher a letter may become. Less wastes cells; more, and it loses its
/// look.
inline constexpr double max_glyph_stretch = 1.5;

/// A letter or a short word on a panel, binary: a cell is letter where ink covers at least half of it.
///
/// The ink is scaled to the panel less its margin, in its own proportions as far as the tighter side allows.
/// Then it is stretched along the other side until that is filled too, by at most 1.5, and centred. Room is
/// never left unused that a stroke could fill, so that strokes are as wide as the panel allows for a letter
/// that keeps its look; hence where strokes are still thinner than a cell, only a larger panel helps.
///
/// Where strokes are lost all the same, `needed` of the goal names the smallest larger panel that keeps them
/// (whole_picture.hpp).
/// @param text UTF-8, 1 to 12 characters
/// @param cell_shape distance of neighbouring columns over that of neighbouring rows
/// @throws InvalidInput for another number of characters, and what glyph_picture and make_goal refuse; where
/// a larger panel helps the message names it
DisplayGoal glyph_goal(const std::string& text, const FontFile& font, int columns, int rows,
                       double cell_shape = 1);

/// In the first of fonts_by_default whose strokes the panel keeps, else in the last of them.
DisplayGoal glyph_goal(const std::string& text, int columns, int rows, double cell_shape = 1);

}  // namespace kinetix::targets
