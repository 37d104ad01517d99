#pragma once

#include <string_view>

#include "targets/display/pix.hpp"

namespace kinetix::targets {

/// Decodes a PNG to 8 bits per value; 16 bits lose their lower half. A picture of grey values alone has 8 bits per
/// pixel. All others are colour in 32 bits, with alpha if the file has any. Writes nothing to stderr for any file;
/// leptonica's reader leaves messages to libpng, which prints them.
/// @throws InvalidInput without place for a damaged file, with libpng's reason
PixPointer read_png(std::string_view bytes);

}  // namespace kinetix::targets
