#include "targets/display/image_goal.hpp"

#include <leptonica/allheaders.h>
#include <png.h>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <new>

#include "targets/display/whole_picture.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

constexpr int opaque = 255;  // alpha of 8 bits, the largest: of pixels that have none of their own

/// Keeps libpng's reason for an error. It must not return to where the error is.
void keep_reason(png_structp png, png_const_charp reason) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = reason;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void next_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto& rest = *static_cast<std::string_view*>(png_get_io_ptr(png));
  if (rest.size() < count) png_error(png, "it ends too early");
  std::memcpy(to, rest.data(), count);
  rest.remove_prefix(count);
}

struct Decoder {
  std::string reason;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reason, keep_reason, ignore_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;

  Decoder() = default;
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
};

/// Decodes the file; false if libpng gave up. No object here needs a destructor, since longjmp would skip it.
bool decode(const Decoder& decoder) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_read_png(decoder.png, decoder.info, PNG_TRANSFORM_EXPAND | PNG_TRANSFORM_STRIP_16, nullptr);
  return true;
}

l_uint32 pixel_of(const png_byte* values, int channels) {
  const bool is_grey = channels <= 2, has_alpha = channels == 2 || channels == 4;
  l_uint32 pixel = 0;
  composeRGBAPixel(values[0], values[is_grey ? 0 : 1], values[is_grey ? 0 : 2],
                   has_alpha ? values[channels - 1] : opaque, &pixel);
  return pixel;
}

PixPointer picture_of(const Decoder& decoder) {
  const int width = static_cast<int>(png_get_image_width(decoder.png, decoder.info)),
            height = static_cast<int>(png_get_image_height(decoder.png, decoder.info)),
            channels = png_get_channels(decoder.png, decoder.info);
  PixPointer pix = owned(pixCreate(width, height, channels == 1 ? 8 : 32));
  if (channels == 2 || channels == 4) pixSetSpp(pix.get(), 4);
  png_bytepp rows = png_get_rows(decoder.png, decoder.info);
  for (int y = 0; y < height; ++y) {
    l_uint32* const line = pixGetData(pix.get()) + static_cast<std::size_t>(y) * pixGetWpl(pix.get());
    for (int x = 0; x < width; ++x)
      if (channels == 1)
        SET_DATA_BYTE(line, x, rows[y][x]);
      else
        line[x] = pixel_of(rows[y] + static_cast<std::size_t>(x) * channels, channels);
  }
  return pix;
}

}  // namespace

PixPointer read_png(std::string_view bytes) {
  Decoder decoder;
  if (decoder.info == nullptr) throw std::bad_alloc();
  png_set_read_fn(decoder.png, &bytes, next_bytes);
  if (!decode(decoder))
    throw InvalidInput("is damaged and cannot be decoded (" + decoder.reason + "). Give a whole PNG file");
  return picture_of(decoder);
}

namespace {

struct Header {
  l_int32 format = 0, width = 0, height = 0, bits = 0, samples = 0, has_colormap = 0;
};

const l_uint8* data_of(const std::string& bytes) { return reinterpret_cast<const l_uint8*>(bytes.data()); }

void check_format(const Header& header) {
  const bool is_grey_pnm = header.format == IFF_PNM && header.samples == 1;
  if (header.format != IFF_PNG && header.format != IFF_JFIF_JPEG && !is_grey_pnm)
    throw InvalidInput("is not an image of an allowed format. Give a PNG, JPEG, PBM or PGM file");
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
        "is not an image that can be read. Give a PNG, JPEG, PBM or PGM file, a PGM whose largest value is "
        "3, 15, 255 or 65535");
  check_format(header);
  check_size(header);
  return header;
}

PixPointer read_pnm(const std::string& bytes) {
  PixPointer pix(pixReadMem(data_of(bytes), bytes.size()));
  if (!pix) throw InvalidInput("is damaged and cannot be decoded. Give a whole PBM or PGM file");
  return pix;
}

PixPointer read_jpeg(const std::string& bytes) {
  l_int32 warnings = 0;
  PixPointer pix(pixReadMemJpeg(data_of(bytes), bytes.size(), 0, 1, &warnings, 0));
  if (!pix || warnings > 0) throw InvalidInput("is damaged and cannot be decoded. Give a whole JPEG file");
  return pix;
}

PixPointer read_pixels(const std::string& bytes) {
  const int format = checked_header(bytes).format;
  if (format == IFF_PNG) return read_png(bytes);
  return format == IFF_JFIF_JPEG ? read_jpeg(bytes) : read_pnm(bytes);
}

/// Decodes an image to 8 bits per pixel, 0 = black.
PixPointer decode(const std::string& bytes) {
  PixPointer pix = read_pixels(bytes);
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
    throw InvalidInput("has one value everywhere. Give an image with a letter and a background");
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
  const int min_light = levels == ImageLevels::two ? otsu_threshold(grey.get()) : 0;
  for (std::uint8_t& ink : picture.ink) {
    if (levels == ImageLevels::two) ink = 255 - ink < min_light ? 255 : 0;
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

namespace {

PanelSize default_size(const Picture& picture, double cell_shape) {
  const double rows =
      std::round(cell_shape * static_cast<double>(default_image_columns) * picture.height / picture.width);
  return {default_image_columns, static_cast<int>(std::max(rows, 1.0))};
}

DisplayGoal shown(const std::shared_ptr<const Picture>& picture, PanelSize size, ImageLevels levels,
                  bool inverted) {
  check_panel(size);
  const auto window = [&](PanelSize) { return frame(*picture); };
  DisplayGoal goal = levels == ImageLevels::two
                         ? sampled(*picture, window, size)
                         : make_goal(size, ink_coverage(*picture, frame(*picture), size));
  if (levels == ImageLevels::two) compare_with(*picture, window, goal);
  check_contrast(goal);
  goal.inverted = inverted;
  goal.resized = [=](PanelSize other) { return shown(picture, other, levels, inverted); };
  return goal;
}

}  // namespace

DisplayGoal image_goal(const std::string& file, std::optional<PanelSize> size, ImageLevels levels,
                       bool invert, double cell_shape) {
  const auto picture = std::make_shared<const Picture>(read_image(file, levels, invert));
  return shown(picture, size.value_or(default_size(*picture, cell_shape)), levels, invert);
}

}  // namespace kinetix::targets
