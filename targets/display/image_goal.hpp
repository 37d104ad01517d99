#pragma once

#include "targets/display/display_goal.hpp"
#include "targets/display/picture.hpp"

namespace kinetix::targets {

/// Decodes a PNG to 8 bits per value; 16 bits lose their lower half. A picture of grey values alone has 8 bits per
/// pixel. All others are colour in 32 bits, with alpha if the file has any. Writes nothing to stderr for any file;
/// leptonica's reader leaves messages to libpng, which prints them.
/// @throws InvalidInput without place for a damaged file, with libpng's reason
PixPointer read_png(std::string_view bytes);

/// Largest size, bytes (256 MiB), of the file and of the decoded image: 4 per allowed pixel.
inline constexpr std::size_t max_image_bytes = 256 << 20;
/// Most pixels, 8000 x 8000: 64 per side of a cell on a panel of 125 cells. More would only cost memory.
inline constexpr long max_image_pixels = 64'000'000;

enum class ImageLevels {
  two,  ///< pixels are ink or paper, separated by Otsu's threshold (Otsu 1979, IEEE Trans. SMC 9, 62)
  grey
};

/// Reads a PNG, JPEG, PBM or PGM file as ink. A PGM must declare 3, 15, 255 or 65535 as its largest value. Transparent
/// pixels are white; colours count by their luminance.
/// @param invert false: dark is ink; true: light is ink.
/// @throws InvalidInput with the file alone as place. Causes are a missing, unreadable or damaged file, another
/// format, an image of one value, over 64 megapixels, and over 256 MiB (in the file, or decoded). Both limits are
/// checked in the header, before decoding.
Picture read_image(const std::string& file, ImageLevels levels, bool invert);

/// Default columns: enough for a simple drawing. More cost the search time and memory.
inline constexpr int default_image_columns = 20;

/// Draws the whole image on the whole panel, each side scaled separately, without a margin. A cell's level is the ink
/// in its area; with two levels a cell is letter if ink covers at least half of it. If strokes of an image of two
/// levels are lost, `needed` of the goal names the smallest larger panel that keeps them (whole_picture.hpp).
/// @param size [columns, rows]; empty: 20 columns, and the rows that keep the image's proportions.
/// @param cell_shape distance of neighbouring columns over that of neighbouring rows.
/// @throws InvalidInput for what read_image and make_goal refuse
DisplayGoal image_goal(const std::string& file, std::optional<PanelSize> size = {},
                       ImageLevels levels = ImageLevels::two, bool invert = false, double cell_shape = 1);

}  // namespace kinetix::targets
