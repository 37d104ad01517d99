#include "targets/display/glyph_goal.hpp"

#include <fontconfig/fontconfig.h>
#include <freetype/freetype.h>
#include <freetype/ftbbox.h>
#include <freetype/ftoutln.h>
#include <raqm.h>
#include <unigbrk.h>
#include <cmath>
#include <cstdio>
#include <new>
#include <set>
#include <tuple>
#include <type_traits>

#include "targets/display/whole_picture.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

// Most families named in a message, so that it takes a few lines of a terminal.
constexpr std::size_t max_names = 12;

struct Destroy {
  void operator()(FcConfig* config) const { FcConfigDestroy(config); }
  void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
  void operator()(FcObjectSet* set) const { FcObjectSetDestroy(set); }
  void operator()(FcFontSet* set) const { FcFontSetDestroy(set); }
};
using Config = std::unique_ptr<FcConfig, Destroy>;
using Fonts = std::unique_ptr<FcFontSet, Destroy>;

Config installed_fonts() {
  Config config(FcInitLoadConfigAndFonts());
  if (!config) throw std::bad_alloc();
  return config;
}

/// Returns the installed outline fonts with this value under the key; all of them if the key is null.
Fonts outline_fonts(const Config& config, const char* key = nullptr, const std::string& value = {}) {
  const std::unique_ptr<FcPattern, Destroy> pattern(FcPatternCreate());
  const std::unique_ptr<FcObjectSet, Destroy> wanted(FcObjectSetBuild(
      FC_FAMILY, FC_FILE, FC_INDEX, FC_SLANT, FC_WIDTH, FC_WEIGHT, static_cast<const char*>(nullptr)));
  if (!pattern || !wanted) throw std::bad_alloc();
  FcPatternAddBool(pattern.get(), FC_OUTLINE, FcTrue);
  FcPatternAddBool(pattern.get(), FC_VARIABLE, FcFalse);
  if (key != nullptr) FcPatternAddString(pattern.get(), key, reinterpret_cast<const FcChar8*>(value.c_str()));
  Fonts fonts(FcFontList(config.get(), pattern.get(), wanted.get()));
  if (!fonts) throw std::bad_alloc();
  return fonts;
}

std::string text_of(FcPattern* font, const char* key) {
  FcChar8* text = nullptr;
  const bool found = FcPatternGetString(font, key, 0, &text) == FcResultMatch;
  return found ? reinterpret_cast<const char*>(text) : "";
}

int integer_of(FcPattern* font, const char* key) {
  int value = 0;
  FcPatternGetInteger(font, key, 0, &value);
  return value;
}

/// Returns a sort key, least for the most regular font. It orders all fonts, so the choice does not depend on the
/// order of the list.
auto rank(FcPattern* font) {
  return std::tuple(std::abs(integer_of(font, FC_SLANT) - FC_SLANT_ROMAN),
                    std::abs(integer_of(font, FC_WIDTH) - FC_WIDTH_NORMAL),
                    std::abs(integer_of(font, FC_WEIGHT) - FC_WEIGHT_REGULAR), text_of(font, FC_FILE),
                    integer_of(font, FC_INDEX));
}

FcPattern* most_regular(const FcFontSet& fonts) {
  return *std::min_element(fonts.fonts, fonts.fonts + fonts.nfont,
                           [](FcPattern* a, FcPattern* b) { return rank(a) < rank(b); });
}

std::vector<std::string> installed_families(const Config& config) {
  const Fonts fonts = outline_fonts(config);
  std::set<std::string> families;
  for (int k = 0; k < fonts->nfont; ++k) families.insert(text_of(fonts->fonts[k], FC_FAMILY));
  return {families.begin(), families.end()};
}

InvalidInput not_installed(const Config& config, const std::string& name) {
  auto families = installed_families(config);
  if (families.empty())
    return InvalidInput("no outline font is installed. Install one, such as the package fonts-dejavu-core");
  const auto distance = [&](const std::string& family) {
    return spelling_distance(lower_case(name).substr(0, longest_name), lower_case(family));
  };
  std::stable_sort(families.begin(), families.end(),
                   [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const std::size_t count = std::min(families.size(), max_names);
  const std::vector<std::string_view> nearest(families.begin(), families.begin() + count);
  return InvalidInput("the font " + in_ticks(name) + " is not installed; installed families" +
                      (count < families.size() ? " nearest in spelling: " : ": ") + joined(nearest));
}

}  // namespace

FontFile find_font(const std::string& name) {
  const Config config = installed_fonts();
  for (const char* key : {FC_FAMILY, FC_FULLNAME}) {
    const Fonts fonts = outline_fonts(config, key, name);
    if (fonts->nfont == 0) continue;
    FcPattern* const font = most_regular(*fonts);
    return {name, text_of(font, FC_FILE), integer_of(font, FC_INDEX)};
  }
  throw not_installed(config, name);
}

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
      throw InvalidInput("the font " + in_ticks(font_.name) + " has no outlines. Choose another font");
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
      throw InvalidInput("cannot be set in the font " + in_ticks(font_.name) + ". Choose another font");
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
                       "). Choose another font or other letters");
  }

  FT_Outline& load(FT_UInt glyph) const {
    if (FT_Load_Glyph(face_.get(), glyph, FT_LOAD_NO_SCALE) != 0 ||
        face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
      throw InvalidInput("the font " + in_ticks(font_.name) +
                         " has a character without an outline. Choose another font");
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
    throw InvalidInput("shows no ink, as spaces do. Give a letter or a short word");
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
    throw InvalidInput("cannot be drawn in this font. Choose another font");
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

namespace {

Window panel_over(const Picture& letter, PanelSize size, double cell_shape) {
  const int margin = std::min(size[0], size[1]) < min_side_with_margin ? 0 : 1;
  const double wide = cell_shape * (size[0] - 2 * margin), high = size[1] - 2 * margin;  // in cell heights
  const double fill_x = letter.width / wide, fill_y = letter.height / high;  // pixels per cell height
  const double half_width = std::max(fill_x, fill_y / max_glyph_stretch) * cell_shape * size[0] / 2;
  const double half_height = std::max(fill_y, fill_x / max_glyph_stretch) * size[1] / 2;
  const double x = letter.width / 2.0, y = letter.height / 2.0;
  return {x - half_width, x + half_width, y - half_height, y + half_height};
}

DisplayGoal shown(const std::shared_ptr<const Picture>& letter, PanelSize size, double cell_shape) {
  check_panel(size);
  const auto window = [&](PanelSize panel) { return panel_over(*letter, panel, cell_shape); };
  DisplayGoal goal = sampled(*letter, window, size);
  goal.is_text = true;
  compare_with(*letter, window, goal);
  check_contrast(goal);
  goal.resized = [=](PanelSize other) { return shown(letter, other, cell_shape); };
  return goal;
}

void check_length(const std::string& text) {
  if (text.empty()) throw InvalidInput("is empty. Give a letter or a short word");
  const int count = count_letters(text);
  if (count > max_glyph_characters)
    throw InvalidInput("has " + std::to_string(count) + " characters; at most " +
                       std::to_string(max_glyph_characters) + " are allowed");
}

}  // namespace

DisplayGoal glyph_goal(const std::string& text, const FontFile& font, int columns, int rows,
                       double cell_shape) {
  check_length(text);
  check_panel({columns, rows});
  const auto letter = std::make_shared<const Picture>(glyph_picture(text, font));
  return shown(letter, {columns, rows}, cell_shape);
}

DisplayGoal glyph_goal(const std::string& text, int columns, int rows, double cell_shape) {
  for (std::size_t k = 0; k + 1 < fonts_by_default.size(); ++k) {
    try {
      DisplayGoal goal = glyph_goal(text, find_font(fonts_by_default[k]), columns, rows, cell_shape);
      if (goal.whole) return goal;
    } catch (const InvalidInput&) {  // the last font reports the error
    }
  }
  return glyph_goal(text, find_font(fonts_by_default.back()), columns, rows, cell_shape);
}

}  // namespace kinetix::targets
