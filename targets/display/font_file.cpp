#include "targets/display/font_file.hpp"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <set>
#include <tuple>
#include <vector>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

// Most families named in a message, so that it takes a few lines of a terminal.
constexpr std::size_t most_names = 12;

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
    return InvalidInput("no outline font is installed; install one, such as the package fonts-dejavu-core");
  const auto distance = [&](const std::string& family) {
    return spelling_distance(lower_case(name).substr(0, longest_name), lower_case(family));
  };
  std::stable_sort(families.begin(), families.end(),
                   [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const std::size_t count = std::min(families.size(), most_names);
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

}  // namespace kinetix::targets
