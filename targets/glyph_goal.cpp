#include "targets/glyph_goal.hpp"

#include <algorithm>
#include <cmath>

#include "targets/glyph_picture.hpp"
#include "targets/text_file.hpp"
#include "targets/topology.hpp"

namespace kinetix {
namespace {

Window panel_over(const Picture& letter, PanelSize size) {
  const int margin = std::min(size[0], size[1]) < least_side_with_margin ? 0 : 1;
  const double fill_x = static_cast<double>(letter.width) / (size[0] - 2 * margin);  // pixels a cell
  const double fill_y = static_cast<double>(letter.height) / (size[1] - 2 * margin);
  const double half_width = std::max(fill_x, fill_y / max_glyph_stretch) * size[0] / 2;
  const double half_height = std::max(fill_y, fill_x / max_glyph_stretch) * size[1] / 2;
  const double x = letter.width / 2.0, y = letter.height / 2.0;
  return {x - half_width, x + half_width, y - half_height, y + half_height};
}

DisplayGoal shown(const Picture& letter, PanelSize size) {
  return {size[0], size[1], thresholded(ink_coverage(letter, panel_over(letter, size), size))};
}

/// The panel whose shorter side has this many cells.
PanelSize in_proportion(PanelSize asked, int shorter) {
  const auto [least, most] = std::minmax(asked[0], asked[1]);
  const int longer = static_cast<int>(std::lround(static_cast<double>(most) * shorter / least));
  return asked[0] == least ? PanelSize{shorter, longer} : PanelSize{longer, shorter};
}

bool is_allowed(PanelSize size) {
  return std::max(size[0], size[1]) <= max_panel_side &&
         static_cast<long>(size[0]) * size[1] <= max_panel_cells;
}

std::optional<PanelSize> needed_panel(const Picture& letter, const DisplayGoal& goal) {
  const Topology whole = topology(letter);
  if (topology(goal) == whole) return std::nullopt;
  const PanelSize asked = {goal.columns, goal.rows};
  int shorter = std::min(asked[0], asked[1]);
  while (is_allowed(in_proportion(asked, shorter + 1))) {
    ++shorter;
    if (topology(shown(letter, in_proportion(asked, shorter))) == whole) break;
  }
  return in_proportion(asked, shorter);
}

void check_length(const std::string& text) {
  if (text.empty()) throw InvalidInput("is empty; give a letter or a short word");
  const int count = characters(text, 0, text.size());
  if (count > max_glyph_characters)
    throw InvalidInput("has " + std::to_string(count) + " characters; at most " +
                       std::to_string(max_glyph_characters) + " are allowed");
}

}  // namespace

DisplayGoal glyph_goal(const std::string& text, const FontFile& font, int columns, int rows) {
  check_length(text);
  check_panel({columns, rows});
  const Picture letter = glyph_picture(text, font);
  DisplayGoal goal = shown(letter, {columns, rows});
  goal.needed = needed_panel(letter, goal);
  check_contrast(goal);
  return goal;
}

}  // namespace kinetix
