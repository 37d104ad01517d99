#include "targets/display/glyph_picture.hpp"

#include <fontconfig/fontconfig.h>
#include <freetype/freetype.h>
#include <freetype/ftbbox.h>
#include <freetype/ftoutln.h>
#include <raqm.h>
#include <unigbrk.h>

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
  void operator()(raqm_t* layout) const { raqm_destroy(layout); }
};
template <class Handle>
using Owner = std::unique_ptr<std::remove_pointer_t<Handle>, Done>;

// Parts per font unit in lengths of FreeType and HarfBuzz, at a size of one pixel per font unit.
constexpr int parts_of_unit = 64;

std::u32string decoded(const std::string& text) {
  std::u32string codes;
  for (std::size_t k = 0; k < text.size();) {
    FcChar32 code = 0;
    const auto* start = reinterpret_cast<const FcChar8*>(text.data() + k);
    const int length = FcUtf8ToUcs4(start, &code, static_cast<int>(text.size() - k));
    if (length <= 0) throw InvalidInput("is not UTF-8 text");
    codes += static_cast<char32_t>(code);
    k += length;
  }
  return codes;
}

std::string encoded(char32_t code) {
  FcChar8 bytes[FC_UTF8_MAX_LEN];
  return {reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(FcUcs4ToUtf8(code, bytes))};
}

/// A glyph of a text that was shaped, in font units.
struct PlacedGlyph {
  FT_UInt index = 0;
  FT_Vector offset = {}, advance = {};
};

/// Glyphs of a text as outlines in font units, y upwards, on one line that starts at 0. HarfBuzz shapes them; their
/// order is that on the line.
class Line {
 public:
  Line(const std::string& text, const FontFile& font) : text_(decoded(text)), font_(font) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) throw std::bad_alloc();
    library_.reset(library);
    FT_Face face = nullptr;
    if (FT_New_Face(library, font.path.c_str(), font.face, &face) != 0)
      throw InvalidInput("the font file " + font.path + " cannot be read");
    face_.reset(face);
    const FT_F26Dot6 size = static_cast<FT_F26Dot6>(face->units_per_EM) * parts_of_unit;
    if (!FT_IS_SCALABLE(face) || FT_Set_Char_Size(face, size, size, 0, 0) != 0)
      throw InvalidInput("the font " + in_ticks(font_.name) + " has no outlines; choose another font");
    shape();
  }

  FT_Library library() const { return library_.get(); }

  void for_each_outline(const auto& f) const {
    FT_Vector pen = {};
    for (const PlacedGlyph& glyph : glyphs_) {
      FT_Outline& outline = load(glyph.index);
      FT_Outline_Translate(&outline, pen.x + glyph.offset.x, pen.y + glyph.offset.y);
      if (outline.n_points > 0) f(outline);
      pen.x += glyph.advance.x;
      pen.y += glyph.advance.y;
    }
  }

 private:
  void shape() {
    const Owner<raqm_t*> layout(raqm_create());
    static_assert(sizeof(char32_t) == sizeof(std::uint32_t));
    const auto* codes = reinterpret_cast<const std::uint32_t*>(text_.data());
    bool is_done = layout && raqm_set_text(layout.get(), codes, text_.size()) &&
                   raqm_set_freetype_face(layout.get(), face_.get()) &&
                   raqm_set_freetype_load_flags(layout.get(), FT_LOAD_NO_HINTING) &&
                   raqm_set_par_direction(layout.get(), RAQM_DIRECTION_DEFAULT);
    for (const char* off : {"-kern", "-liga", "-clig"})
      is_done = is_done && raqm_add_font_feature(layout.get(), off, -1);
    if (!is_done || !raqm_layout(layout.get()))
      throw InvalidInput("cannot be set in the font " + in_ticks(font_.name) + "; choose another font");
    std::size_t count = 0;
    const raqm_glyph_t* glyphs = raqm_get_glyphs(layout.get(), &count);
    for (std::size_t k = 0; k < count; ++k) {
      if (glyphs[k].index == 0) refuse(glyphs[k].cluster);
      glyphs_.push_back({glyphs[k].index,
                         {glyphs[k].x_offset / parts_of_unit, glyphs[k].y_offset / parts_of_unit},
                         {glyphs[k].x_advance / parts_of_unit, glyphs[k].y_advance / parts_of_unit}});
    }
  }

  /// @param first index of the first character of a cluster that has no glyph
  [[noreturn]] void refuse(std::size_t first) const {
    std::size_t missing = first;
    while (missing + 1 < text_.size() && FT_Get_Char_Index(face_.get(), text_[missing]) != 0) ++missing;
    char number[16];
    std::snprintf(number, sizeof number, "U+%04lX", static_cast<unsigned long>(text_[missing]));
    throw InvalidInput("the font " + in_ticks(font_.name) + " has no character " +
                       in_ticks(encoded(text_[missing])) + " (" + number +
                       "); choose another font or other letters");
  }

  FT_Outline& load(FT_UInt glyph) const {
    if (FT_Load_Glyph(face_.get(), glyph, FT_LOAD_NO_SCALE) != 0 ||
        face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
      throw InvalidInput("the font " + in_ticks(font_.name) +
                         " has a character without an outline; choose another font");
    return face_->glyph->outline;
  }

  std::u32string text_;
  const FontFile& font_;
  Owner<FT_Library> library_;
  Owner<FT_Face> face_;
  std::vector<PlacedGlyph> glyphs_;
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

/// Returns the scale from font units to 64ths of a pixel, so that the box fills the picture.
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

int count_letters(const std::string& text) {
  std::string ends(text.size(), 0);
  u8_grapheme_breaks(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), ends.data());
  return static_cast<int>(std::count(ends.begin(), ends.end(), 1));
}

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
