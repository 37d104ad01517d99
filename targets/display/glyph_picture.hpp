#pragma once

#include <string>

#include "targets/display/font_file.hpp"
#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// px, height of the drawn text: at least one a cell on the largest panel that is allowed.
inline constexpr int glyph_height_pixels = 1024;
/// px, width of the drawn text, 16 times its height: bounds the memory of a line of very wide characters.
inline constexpr int max_glyph_width_pixels = 16'384;

/// The text as its outlines in the font, set one after the other by their advance widths: no kerning (on a
/// coarse panel the gap between two letters counts for more), no hinting, no shaping of scripts that join
/// their letters. The picture is cropped to the ink, and 1024 pixels high or, for text over 16 times as wide
/// as high, 16 384 pixels wide. Each pixel holds the covered part of its area to 1/255, by FreeType's integer
/// arithmetic: the same pixels on every machine that has the same font file.
/// @param text UTF-8
/// @throws InvalidInput for a character that the font does not have, text without ink (spaces), and a font
/// file that FreeType cannot use
Picture glyph_picture(const std::string& text, const FontFile& font);

}  // namespace kinetix::targets
