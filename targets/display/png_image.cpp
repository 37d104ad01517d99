#include "targets/display/png_image.hpp"

#include <leptonica/allheaders.h>
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <new>
#include <string>

#include "model/base/invalid_input.hpp"

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
    throw InvalidInput("is damaged and cannot be decoded (" + decoder.reason + "); give a whole PNG file");
  return picture_of(decoder);
}

}  // namespace kinetix::targets
