#include "targets/display/glyph_picture.hpp"

#include <fontconfig/fontconfig.h>
#include <freetype/freetype.h>
#include <freetype/ftbbox.h>
#include <freetype/ftoutln.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

struct Done {
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
  void operator()(FT_Face face) const { FT_Done_Face(face); }
};
template <class Handle>
using Owner = std::unique_ptr<std::remove_pointer_t<Handle>, Done>;

struct Character {
  std::string text;
  FT_ULong code;
};

std::vector<Character> characters_of(const std::string& text) {
  std::vector<Character> characters;
  for (std::size_t k = 0; k < text.size();) {
    FcChar32 code = 0;
    const auto* start = reinterpret_cast<const FcChar8*>(text.data() + k);
    const int length = FcUtf8ToUcs4(start, &code, static_cast<int>(text.size() - k));
    if (length <= 0) throw InvalidInput("is not UTF-8 text");
    characters.push_back({text.substr(k, length), code});
    k += length;
  }
  return characters;
}

/// The glyphs of a text as outlines in font units, y upwards, on one line that starts at 0.
class Line {
 public:
  Line(const std::string& text, const FontFile& font) : text_(characters_of(text)), font_(font) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) throw std::bad_alloc();
    library_.reset(library);
    FT_Face face = nullptr;
    if (FT_New_Face(library, font.path.c_str(), font.face, &face) != 0)
      throw InvalidInput("the font file " + font.path + " cannot be read");
    face_.reset(face);
  }

  FT_Library library() const { return library_.get(); }

  void for_each_outline(const auto& f) const {
    FT_Pos pen = 0;
    for (const Character& character : text_) {
      FT_Outline& outline = load(character);
      FT_Outline_Translate(&outline, pen, 0);
      if (outline.n_points > 0) f(outline);
      pen += face_->glyph->advance.x;
    }
  }

 private:
  FT_Outline& load(const Character& character) const {
    const FT_UInt glyph = FT_Get_Char_Index(face_.get(), character.code);
    if (glyph == 0) {
      char number[16];
      std::snprintf(number, sizeof number, "U+%04lX", character.code);
      throw InvalidInput("the font " + in_ticks(font_.name) + " has no character " +
                         in_ticks(character.text) + " (" + number +
                         "); choose another font or other letters");
    }
    if (FT_Load_Glyph(face_.get(), glyph, FT_LOAD_NO_SCALE) != 0 ||
        face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
      throw InvalidInput("the font " + in_ticks(font_.name) + " has no outline of " +
                         in_ticks(character.text) + "; choose another font");
    return face_->glyph->outline;
  }

  std::vector<Character> text_;
  const FontFile& font_;
  Owner<FT_Library> library_;
  Owner<FT_Face> face_;
};

FT_BBox ink_box(const Line& line) {
  FT_BBox all = {};
  bool is_first = true;
  line.for_each_outline([&](FT_Outline& outline) {
    FT_BBox box;
    if (FT_Outline_Get_BBox(&outline, &box) != 0) return;
    all = is_first ? box
                   : FT_BBox{std::min(all.xMin, box.xMin), std::min(all.yMin, box.yMin),
                             std::max(all.xMax, box.xMax), std::max(all.yMax, box.yMax)};
    is_first = false;
  });
  if (!(all.xMin < all.xMax && all.yMin < all.yMax))
    throw InvalidInput("shows no ink, as spaces do; give a letter or a short word");
  return all;
}

Picture blank_for(const FT_BBox& box) {
  const double width = static_cast<double>(box.xMax - box.xMin);
  const double height = static_cast<double>(box.yMax - box.yMin);
  const double scale = std::min(glyph_height_pixels / height, max_glyph_width_pixels / width);
  Picture picture{std::max(1, static_cast<int>(std::lround(scale * width))),
                  std::max(1, static_cast<int>(std::lround(scale * height))),
                  {}};
  picture.ink.resize(static_cast<std::size_t>(picture.width) * picture.height);
  return picture;
}

/// From font units to 64ths of a pixel, so that the box fills the picture.
FT_Matrix scale_to(const Picture& picture, const FT_BBox& box) {
  const auto factor = [](int pixels, FT_Pos units) { return FT_DivFix(64 * pixels, units); };
  return {factor(picture.width, box.xMax - box.xMin), 0, 0, factor(picture.height, box.yMax - box.yMin)};
}

std::vector<std::uint8_t> rasterised(FT_Library library, FT_Outline& outline, const Picture& picture) {
  std::vector<std::uint8_t> ink(picture.ink.size());
  FT_Bitmap bitmap = {};
  bitmap.width = static_cast<unsigned>(picture.width);
  bitmap.rows = static_cast<unsigned>(picture.height);
  bitmap.pitch = picture.width;
  bitmap.buffer = ink.data();
  bitmap.num_grays = 256;
  bitmap.pixel_mode = FT_PIXEL_MODE_GRAY;
  if (FT_Outline_Get_Bitmap(library, &outline, &bitmap) != 0)
    throw InvalidInput("cannot be drawn in this font; choose another font");
  return ink;
}

}  // namespace

Picture glyph_picture(const std::string& text, const FontFile& font) {
  const Line line(text, font);
  const FT_BBox box = ink_box(line);
  Picture picture = blank_for(box);
  const FT_Matrix scale = scale_to(picture, box);
  line.for_each_outline([&](FT_Outline& outline) {
    FT_Outline_Translate(&outline, -box.xMin, -box.yMin);
    FT_Outline_Transform(&outline, &scale);
    const auto glyph = rasterised(line.library(), outline, picture);
    std::transform(glyph.begin(), glyph.end(), picture.ink.begin(), picture.ink.begin(),
                   [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
  });
  return picture;
}

}  // namespace kinetix::targets
