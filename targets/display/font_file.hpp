#pragma once

#include <array>
#include <string>

#include "model/base/invalid_input.hpp"

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

}  // namespace kinetix::targets
