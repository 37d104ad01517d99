#pragma once

#include <leptonica/allheaders.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace kinetix::testing {

/// Grey values by rows from the top, 0 = black, of 1, 8 or 16 bits.
using Greys = std::vector<std::vector<unsigned>>;

/// A picture of two values: `dark` where the row holds `#`.
inline Greys drawn(const std::vector<std::string>& rows, unsigned dark = 0, unsigned light = 255) {
  Greys greys;
  for (const std::string& row : rows) {
    greys.emplace_back();
    for (const char c : row) greys.back().push_back(c == '#' ? dark : light);
  }
  return greys;
}

/// Sets the pixels, writes the file, and destroys the picture.
inline std::string write_pix(PIX* pix, const Greys& values, const std::string& file, int format) {
  for (std::size_t y = 0; y < values.size(); ++y)
    for (std::size_t x = 0; x < values[y].size(); ++x)
      pixSetPixel(pix, static_cast<int>(x), static_cast<int>(y), values[y][x]);
  const bool failed = pixWrite(file.c_str(), pix, format) != 0;
  pixDestroy(&pix);
  if (failed) throw std::runtime_error("cannot write " + file);
  return file;
}

inline PIX* make_pix(const Greys& values, int bits) {
  return pixCreate(static_cast<int>(values[0].size()), static_cast<int>(values.size()), bits);
}

/// Writes an image file. In 1 bit every value but 0 is black, as leptonica has it.
inline std::string write_image(const std::string& file, const Greys& greys, int format = IFF_PNG,
                               int bits = 8) {
  return write_pix(make_pix(greys, bits), greys, file, format);
}

/// A PNG of red, green, blue, alpha a pixel, 0xRRGGBBAA.
inline std::string write_colour_image(const std::string& file, const Greys& colours) {
  PIX* pix = make_pix(colours, 32);
  pixSetSpp(pix, 4);
  return write_pix(pix, colours, file, IFF_PNG);
}

}  // namespace kinetix::testing
