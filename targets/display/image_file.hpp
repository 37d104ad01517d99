#pragma once

#include <cstddef>
#include <string>

#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// Bytes, 256 MiB, of the file and of what it decodes to: 4 for each of the pixels that are allowed.
inline constexpr std::size_t max_image_bytes = 256 << 20;
/// px in all, 8000 x 8000: 64 for each side of a cell of a panel of 125 cells. More would only cost memory.
inline constexpr long max_image_pixels = 64'000'000;

enum class ImageLevels {
  two,  ///< pixels are ink or paper, told apart by Otsu's threshold (Otsu 1979, IEEE Trans. SMC 9, 62)
  grey
};

/// A PNG, PBM or PGM file as ink; a PGM must declare 3, 15, 255 or 65535 as its largest value. Transparent
/// pixels are white, colours count by their luminance.
/// @param invert false: dark is ink; true: light is
/// @throws InvalidInput with the file alone as place: missing, unreadable or damaged, of another format, over
/// 64 megapixels or 256 MiB (in the file, or decoded; found in the header, before decoding), all of one value
Picture read_image(const std::string& file, ImageLevels levels, bool invert);

}  // namespace kinetix::targets
