#include "targets/display/image_file.hpp"

#include <leptonica/allheaders.h>

#include <algorithm>
#include <new>

#include "targets/display/pix.hpp"
#include "targets/display/png_image.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

struct Header {
  l_int32 format = 0, width = 0, height = 0, bits = 0, samples = 0, has_colormap = 0;
};

const l_uint8* data_of(const std::string& bytes) { return reinterpret_cast<const l_uint8*>(bytes.data()); }

void check_format(const Header& header) {
  const bool is_grey_pnm = header.format == IFF_PNM && header.samples == 1;
  if (header.format != IFF_PNG && !is_grey_pnm)
    throw InvalidInput("is not an image of an allowed format; give a PNG, PBM or PGM file");
}

void check_size(const Header& header) {
  if (header.width < 1 || header.height < 1) throw InvalidInput("is damaged: it has no pixels");
  const long pixels = static_cast<long>(header.width) * header.height;
  if (pixels > max_image_pixels)
    throw InvalidInput("is too large: " + std::to_string(header.width) + " x " +
                       std::to_string(header.height) + " pixels; at most " +
                       std::to_string(max_image_pixels / 1'000'000) + " megapixels are allowed");
  const auto bytes = static_cast<std::size_t>(pixels) * header.samples * header.bits / 8;
  if (bytes > max_image_bytes)
    throw InvalidInput("is too large: " + byte_count(bytes) + " once decoded; at most " +
                       byte_count(max_image_bytes) + " are allowed");
}

Header checked_header(const std::string& bytes) {
  Header header;
  if (pixReadHeaderMem(data_of(bytes), bytes.size(), &header.format, &header.width, &header.height,
                       &header.bits, &header.samples, &header.has_colormap) != 0)
    throw InvalidInput(
        "is not an image that can be read; give a PNG, PBM or PGM file, a PGM whose largest value is "
        "3, 15, 255 or 65535");
  check_format(header);
  check_size(header);
  return header;
}

PixPointer read_pnm(const std::string& bytes) {
  PixPointer pix(pixReadMem(data_of(bytes), bytes.size()));
  if (!pix) throw InvalidInput("is damaged and cannot be decoded; give a whole PBM or PGM file");
  return pix;
}

/// Decodes an image to 8 bits per pixel, 0 = black.
PixPointer decode(const std::string& bytes) {
  PixPointer pix = checked_header(bytes).format == IFF_PNG ? read_png(bytes) : read_pnm(bytes);
  if (pixGetSpp(pix.get()) == 4) pix = owned(pixAlphaBlendUniform(pix.get(), 0xffffff00));
  return owned(pixConvertTo8(pix.get(), 0));
}

Picture picture_of(PIX* grey) {
  Picture picture{pixGetWidth(grey), pixGetHeight(grey), {}};
  picture.ink.reserve(static_cast<std::size_t>(picture.width) * picture.height);
  for (int y = 0; y < picture.height; ++y) {
    const l_uint32* const line = pixGetData(grey) + static_cast<std::size_t>(y) * pixGetWpl(grey);
    for (int x = 0; x < picture.width; ++x)
      picture.ink.push_back(static_cast<std::uint8_t>(255 - GET_DATA_BYTE(line, x)));
  }
  return picture;
}

/// Least grey value of the light class.
int otsu_threshold(PIX* grey) {
  NUMA* histogram = pixGetGrayHistogram(grey, 1);
  l_int32 threshold = 0;
  const bool failed =
      numaSplitDistribution(histogram, 0, &threshold, nullptr, nullptr, nullptr, nullptr, nullptr) != 0;
  numaDestroy(&histogram);
  if (failed) throw std::bad_alloc();
  return threshold;
}

void check_variety(const Picture& picture) {
  const auto [least, most] = std::minmax_element(picture.ink.begin(), picture.ink.end());
  if (*least == *most)
    throw InvalidInput("has one value everywhere; give an image with a letter and a background");
}

/// Silences leptonica: its messages, by severity, and the header values that it prints straight to stderr.
void be_silent() {
  setMsgSeverity(L_SEVERITY_NONE);
  leptSetStderrHandler([](const char*) {});
}

Picture read(const std::string& bytes, ImageLevels levels, bool invert) {
  be_silent();
  const PixPointer grey = decode(bytes);
  Picture picture = picture_of(grey.get());
  check_variety(picture);
  const int least_light = levels == ImageLevels::two ? otsu_threshold(grey.get()) : 0;
  for (std::uint8_t& ink : picture.ink) {
    if (levels == ImageLevels::two) ink = 255 - ink < least_light ? 255 : 0;
    if (invert) ink = static_cast<std::uint8_t>(255 - ink);
  }
  return picture;
}

}  // namespace

Picture read_image(const std::string& file, ImageLevels levels, bool invert) {
  const std::string bytes = read_bytes(file, max_image_bytes);
  try {
    return read(bytes, levels, invert);
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {file});
  }
}

}  // namespace kinetix::targets
