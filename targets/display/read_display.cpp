#include "targets/display/display_goal.hpp"

#include <filesystem>

#include "targets/display/glyph_goal.hpp"
#include "targets/display/image_goal.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::targets {
namespace {

// Columns per character, and rows: a margin of one cell leaves 8, in which strokes and gaps of a capital are one or
// two cells wide.
constexpr int default_cells_per_character = 10;
// Words of the key `levels`.
constexpr Word<ImageLevels> level_choices[] = {{"2", ImageLevels::two}, {"grey", ImageLevels::grey}};
// End of messages about a target with no source of its picture, or with several.
constexpr const char* wanted_source = "one of `glyph`, `image` and `rows`";

PanelSize read_cells_of_panel(const Node& cells) {
  const auto sides = cells.list_of(2, "[columns, rows]: the cells of a display fill a rectangle");
  const PanelSize size = {sides[0].integer(min_panel_side, max_panel_side),
                          sides[1].integer(min_panel_side, max_panel_side)};
  cells.located([&] { check_panel(size); });
  return size;
}

DisplayGoal read_glyph(const Section& target, const Node& glyph, const std::optional<PanelSize>& size,
                       double cell_shape) {
  target.node().reject_unknown_keys(display_target_keys().only("glyph").names());
  const std::string text = glyph.text("a letter or a short word");
  const auto font_key = target.optional("font");
  const int columns = default_cells_per_character * count_letters(text);
  const PanelSize cells = size.value_or(PanelSize{columns, default_cells_per_character});
  if (!font_key) return glyph.located([&] { return glyph_goal(text, cells[0], cells[1], cell_shape); });
  const std::string name = font_key->text("the name of an installed font");
  const FontFile font = font_key->located([&] { return find_font(name); });
  return glyph.located([&] { return glyph_goal(text, font, cells[0], cells[1], cell_shape); });
}

DisplayGoal read_image_section(const Section& target, const Node& image, const std::optional<PanelSize>& size,
                               double cell_shape) {
  target.node().reject_unknown_keys(display_target_keys().only("image").names());
  const std::string name = image.text("the path of a PNG, JPEG, PBM or PGM file");
  ImageLevels levels = ImageLevels::two;
  bool invert = false;
  target.read("levels", levels, level_choices);
  target.read("invert", invert);
  try {
    return image_goal((std::filesystem::path(image.folder()) / name).string(), size, levels, invert,
                      cell_shape);
  } catch (const InvalidInput& e) {
    throw image.error(e.what());
  }
}

DisplayGoal read_rows(const Section& target, const Node& rows, const std::optional<PanelSize>& size,
                      const std::optional<Node>& cells) {
  target.node().reject_unknown_keys(display_target_keys().only("rows").names());
  std::vector<std::string> texts;
  for (const Node& row : rows.list("rows of 0 and 1 such as [\"0110\", \"1001\"], top row first")) {
    texts.push_back(row.text("a row of 0 and 1 such as \"0110\""));
    row.located([&] { check_row(texts.back(), texts.front().size()); });
  }
  const DisplayGoal goal = rows.located([&] { return rows_goal(texts); });
  const PanelSize own = {goal.columns, goal.rows}, asked = size.value_or(own);
  if (asked[0] % own[0] != 0 || asked[1] % own[1] != 0)
    throw cells->error("is not a multiple of the size of target.rows, which is [" + std::to_string(own[0]) +
                       ", " + std::to_string(own[1]) +
                       "]. Give that size or a multiple of it, or remove structure.cells");
  return size ? goal.resized(asked) : goal;
}

}  // namespace

const KeyTable& display_target_keys() {
  static const KeyTable keys(
      {
          goal_kind_key("display"),
          {"glyph", value::text("a letter or a short word"), {}, "letter or word to show, in a font"},
          {"font", value::text("name of an installed font"),
           otherwise("the first of DejaVu Serif, DejaVu Serif Bold and DejaVu Sans Bold whose strokes the "
                     "panel can show"),
           "font of the glyph", "glyph"},
          {"image", value::text("path of a PNG, JPEG, PBM or PGM file"), {}, "picture to show"},
          {"levels", value::choice(level_choices), by_default("2"),
           "levels of the image: 2 (letter and rest), or grey", "image"},
          {"invert", value::boolean(), by_default("false"), "light instead of dark parts are the letter",
           "image"},
          {"rows", value::list(value::text("0 or 1 per cell"), "rows such as `[\"0110\", \"1001\"]`"),
           no_default,
           "picture to show, cell by cell: 1 is letter, top row first. If `structure.cells` is a multiple of "
           "the size, each of its cells becomes several"},
          {"channel", value::choice({"light", "aperture", "area", "rotation"}),
           otherwise("`light`; `aperture` where `variables.offset_mm` is 0"),
           "property of a cell that shows the picture ([definitions](#channels-of-a-display))"},
      },
      {{"glyph", "image", "rows"}});
  return keys;
}

Key panel_cells_key() {
  return {
      "cells", value::list(value::integer(min_panel_side, max_panel_side), "`[columns, rows]`", 2, 2),
      otherwise("glyph: 10 columns per character and 10 rows; image: 20 columns in its proportions; rows: "
                "their size"),
      "the cells of the panel"};
}

DisplayGoal read_display(const Node& node, const std::optional<Node>& cells, double cell_shape) {
  const Section target(node, display_target_keys());
  const auto glyph = target.optional("glyph"), image = target.optional("image"),
             rows = target.optional("rows");
  const int count = glyph.has_value() + image.has_value() + rows.has_value();
  if (count == 0) throw target.error(std::string("the picture is missing. Give ") + wanted_source);
  if (count > 1)
    throw target.error(std::string("the target has more than one picture. Give only ") + wanted_source);
  const auto size = cells ? std::optional(read_cells_of_panel(*cells)) : std::nullopt;
  if (glyph) return read_glyph(target, *glyph, size, cell_shape);
  if (image) return read_image_section(target, *image, size, cell_shape);
  return read_rows(target, *rows, size, cells);
}

}  // namespace kinetix::targets
