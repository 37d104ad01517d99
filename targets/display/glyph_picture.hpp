#pragma once

#include <string>

#include "targets/display/font_file.hpp"
#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// px, height of the drawn text: at least one a cell on the largest panel that is allowed.
inline constexpr int glyph_height_pixels = 1024;
/// px, width of the drawn text, 16 times its height: bounds the memory of a line of very wide characters.
inline constexpr int max_glyph_width_pixels = 16'384;

/// Number of letters as a reader counts them: grapheme clusters of Unicode (UAX 29), so that accents, joiners and variation
/// selectors belong to the letter before them. @param text UTF-8
int count_letters(const std::string& text);

/// Draws a text by its outlines in the font, shaped by HarfBuzz and ordered by Unicode's bidirectional algorithm: Arabic
/// letters join and run to the left, accents stand over their letters. No kerning and no optional ligatures (on a coarse panel
/// the gap between two letters counts for more), no hinting. The picture is cropped to the ink, and 1024 pixels high or, for
/// text over 16 times as wide as high, 16 384 pixels wide. Each pixel holds the covered part of its area to 1/255, by FreeType's
/// integer arithmetic: the same pixels on every machine that has the same font file.
/// @param text UTF-8
/// @throws InvalidInput for a character that the font does not have, text without ink (spaces), and a font
/// file that FreeType cannot use
Picture glyph_picture(const std::string& text, const FontFile& font);

}  // namespace kinetix::targets
