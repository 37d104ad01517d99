#pragma once

#include <array>
#include <string>

#include "model/base/invalid_input.hpp"

namespace kinetix::targets {

/// Of the package fonts-dejavu-core. Bold, since wide strokes need the fewest cells.
inline constexpr const char* default_font = "DejaVu Sans Bold";
/// Those that a letter is drawn in unless the file names one: the first whose strokes the panel keeps. Serifs
/// make letters easier to read from a distance, an I above all, and need more cells.
inline constexpr std::array<const char*, 3> fonts_by_default = {"DejaVu Serif", "DejaVu Serif Bold",
                                                                default_font};

/// An installed outline font.
struct FontFile {
  std::string name;  ///< as it was asked for
  std::string path;
  int face = 0;  ///< index in a file of several fonts, as FreeType takes it
};

/// The most regular font of this family ("DejaVu Sans": upright, of normal width, weight nearest to regular)
/// or, where there is no such family, the font of this full name ("DejaVu Sans Bold"). Case does not matter.
/// Among equals the file whose path comes first in the alphabet is taken. Nothing is substituted.
/// @throws InvalidInput, naming at most 12 installed families, the nearest in spelling first
FontFile find_font(const std::string& name);

}  // namespace kinetix::targets
