#pragma once

#include "model/base/invalid_input.hpp"
#include "targets/display/display_goal.hpp"
#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// Font of the package fonts-dejavu-core. It is bold, since wide strokes need the fewest cells.
inline constexpr const char* default_font = "DejaVu Sans Bold";
/// Fonts tried in turn if the file names none; the first whose strokes the panel keeps is used. Serifs make letters
/// easier to read from a distance, an I above all, and need more cells.
inline constexpr std::array<const char*, 3> fonts_by_default = {"DejaVu Serif", "DejaVu Serif Bold",
                                                                default_font};

/// An installed outline font.
struct FontFile {
  std::string name;  ///< as requested
  std::string path;
  int face = 0;  ///< index in a file of several fonts, as FreeType takes it
};

/// Finds the most regular font of this family ("DejaVu Sans": upright, of normal width, weight nearest to regular). If
/// there is no such family, finds the font of this full name ("DejaVu Sans Bold"). Case does not matter. Ties go to
/// the file whose path comes first in the alphabet. No font is substituted.
/// @throws InvalidInput, naming at most 12 installed families, the nearest in spelling first
FontFile find_font(const std::string& name);

/// Height of the drawn text, px: at least one per cell on the largest allowed panel.
inline constexpr int glyph_height_pixels = 1024;
/// Largest width of the drawn text, px: 16 times its height. It bounds the memory for a line of very wide characters.
inline constexpr int max_glyph_width_pixels = 16'384;

/// Counts letters as a reader does, by grapheme clusters of Unicode (UAX 29). Accents, joiners and variation selectors
/// belong to the letter before them. @param text UTF-8
int count_letters(const std::string& text);

/// Draws a text by its outlines in the font. HarfBuzz shapes it and Unicode's bidirectional algorithm orders it:
/// Arabic letters join and run to the left, and accents are above their letters. Kerning and optional ligatures are
/// off, since the gap between two letters counts for more on a coarse panel. Hinting is off too.
///
/// The picture is cropped to the ink and 1024 pixels high. Text over 16 times as wide as high is 16 384 pixels wide
/// instead. Each pixel holds the covered part of its area to 1/255, by FreeType's integer arithmetic. The same font
/// file gives the same pixels on every machine.
/// @param text UTF-8.
/// @throws InvalidInput for a character that the font lacks, text without ink (spaces), and a font file that FreeType
/// cannot use
Picture glyph_picture(const std::string& text, const FontFile& font);

/// Most characters of a text: a short word. At the default of 10 columns per character the panel is 120 cells wide.
inline constexpr int max_glyph_characters = 12;
/// Least cells on the shorter side of a panel with a margin; the margin is one cell around the letter. On fewer cells
/// a margin would leave the letter less than three, too few for its strokes and gaps.
inline constexpr int min_side_with_margin = 5;
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
