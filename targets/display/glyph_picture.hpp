#pragma once

#include <string>

#include "targets/display/font_file.hpp"
#include "targets/display/picture.hpp"

namespace kinetix::targets {

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

}  // namespace kinetix::targets
