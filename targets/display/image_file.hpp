#pragma once

#include <cstddef>
#include <string>

#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// Largest size, bytes (256 MiB), of the file and of the decoded image: 4 per allowed pixel.
inline constexpr std::size_t max_image_bytes = 256 << 20;
/// Most pixels, 8000 x 8000: 64 per side of a cell on a panel of 125 cells. More would only cost memory.
inline constexpr long max_image_pixels = 64'000'000;

enum class ImageLevels {
  two,  ///< pixels are ink or paper, separated by Otsu's threshold (Otsu 1979, IEEE Trans. SMC 9, 62)
  grey
};

/// Reads a PNG, PBM or PGM file as ink. A PGM must declare 3, 15, 255 or 65535 as its largest value. Transparent
/// pixels are white; colours count by their luminance.
/// @param invert false: dark is ink; true: light is ink.
/// @throws InvalidInput with the file alone as place. Causes are a missing, unreadable or damaged file, another
/// format, an image of one value, over 64 megapixels, and over 256 MiB (in the file, or decoded). Both limits are
/// checked in the header, before decoding.
Picture read_image(const std::string& file, ImageLevels levels, bool invert);

}  // namespace kinetix::targets
