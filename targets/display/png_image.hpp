#pragma once

#include <string_view>

#include "targets/display/pix.hpp"

namespace kinetix::targets {

/// The pixels of a PNG, 8 bits a value (16 bits lose their lower half): grey in 8 bits a pixel where it holds
/// nothing else, else colour in 32 with alpha where it has any. Writes nothing to stderr whatever the file
/// holds; leptonica's own reader leaves libpng's messages to libpng, which prints them.
/// @throws InvalidInput without place for a damaged file, with libpng's reason
PixPointer read_png(std::string_view bytes);

}  // namespace kinetix::targets
