#pragma once

#include <string>

#include "model/invalid_input.hpp"

namespace kinetix {

inline constexpr const char* default_font = "DejaVu Sans Bold";

/// An installed outline font.
struct FontFile {
  std::string name;  ///< as it was asked for
  std::string path;
  int face = 0;  ///< index in a file of several fonts, as FreeType takes it
};

/// The font of this full name ("DejaVu Sans Bold") or, where there is none, the most regular one of this
/// family ("DejaVu Sans": upright, of normal width, weight nearest to regular). Case does not matter. Several
/// files of one name are told apart by their paths, in alphabetical order. Nothing is substituted.
/// @throws InvalidInput, naming at most 12 installed families, the nearest in spelling first
FontFile find_font(const std::string& name);

}  // namespace kinetix
