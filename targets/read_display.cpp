#include "targets/read_display.hpp"

#include <filesystem>

#include "targets/glyph_goal.hpp"
#include "targets/image_goal.hpp"
#include "targets/text_file.hpp"

namespace kinetix {
namespace {

constexpr int default_cells_a_character = 10;
constexpr const char* wanted_source = "one of `glyph`, `image` and `rows`";

PanelSize read_cells_of_panel(const Node& cells) {
  const auto sides = cells.list_of(2, "[columns, rows]: the cells of a display fill a rectangle");
  const PanelSize size = {sides[0].integer(min_panel_side, max_panel_side),
                          sides[1].integer(min_panel_side, max_panel_side)};
  cells.located([&] { check_panel(size); });
  return size;
}

DisplayGoal read_glyph(const Node& target, const Node& glyph, const std::optional<PanelSize>& size) {
  target.reject_unknown_keys({"kind", "glyph", "font", "channel"});
  const std::string text = glyph.text("a letter or a short word");
  const auto font_key = target.optional("font");
  const std::string name = font_key ? font_key->text("the name of an installed font") : default_font;
  const FontFile font = font_key.value_or(glyph).located([&] { return find_font(name); });
  const int columns = default_cells_a_character * characters(text, 0, text.size());
  const auto [width, height] = size.value_or(PanelSize{columns, default_cells_a_character});
  return glyph.located([&] { return glyph_goal(text, font, width, height); });
}

DisplayGoal read_image_section(const Node& target, const Node& image, const std::optional<PanelSize>& size) {
  target.reject_unknown_keys({"kind", "image", "levels", "invert", "channel"});
  const std::string name = image.text("the path of a PNG, PBM or PGM file");
  const auto levels_key = target.optional("levels"), invert_key = target.optional("invert");
  const auto levels =
      levels_key ? levels_key->choice<ImageLevels>({{"2", ImageLevels::two}, {"grey", ImageLevels::grey}})
                 : ImageLevels::two;
  const bool invert = invert_key && invert_key->boolean();
  try {
    return image_goal((std::filesystem::path(image.folder()) / name).string(), size, levels, invert);
  } catch (const InvalidInput& e) {
    throw image.error(e.what());
  }
}

DisplayGoal read_rows(const Node& target, const Node& rows, const std::optional<PanelSize>& size,
                      const std::optional<Node>& cells) {
  target.reject_unknown_keys({"kind", "rows", "channel"});
  std::vector<std::string> texts;
  for (const Node& row : rows.list("rows of 0 and 1 such as [\"0110\", \"1001\"], top row first")) {
    texts.push_back(row.text("a row of 0 and 1 such as \"0110\""));
    row.located([&] { check_row(texts.back(), texts.front().size()); });
  }
  DisplayGoal goal = rows.located([&] { return rows_goal(texts); });
  const PanelSize own = {goal.columns, goal.rows};
  if (size.value_or(own) != own)
    throw cells->error("is not the size of target.rows, which is [" + std::to_string(own[0]) + ", " +
                       std::to_string(own[1]) + "]; give that, or leave structure.cells out");
  return goal;
}

}  // namespace

DisplayGoal read_display(const Node& target, const std::optional<Node>& cells) {
  target.reject_unknown_keys({"kind", "glyph", "font", "image", "levels", "invert", "rows", "channel"});
  const auto glyph = target.optional("glyph"), image = target.optional("image"),
             rows = target.optional("rows");
  const int count = glyph.has_value() + image.has_value() + rows.has_value();
  if (count == 0) throw target.error(std::string("says nothing to show; give ") + wanted_source);
  if (count > 1)
    throw target.error(std::string("gives more than one thing to show; give only ") + wanted_source);
  const auto size = cells ? std::optional(read_cells_of_panel(*cells)) : std::nullopt;
  if (glyph) return read_glyph(target, *glyph, size);
  if (image) return read_image_section(target, *image, size);
  return read_rows(target, *rows, size, cells);
}

}  // namespace kinetix
