#include "targets/display/glyph_goal.hpp"

#include <algorithm>
#include <memory>

#include "targets/display/glyph_picture.hpp"
#include "targets/display/whole_picture.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::targets {
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

DisplayGoal shown(const std::shared_ptr<const Picture>& letter, PanelSize size) {
  check_panel(size);
  const auto window = [&](PanelSize panel) { return panel_over(*letter, panel); };
  DisplayGoal goal = sampled(*letter, window, size);
  compare_with(*letter, window, goal);
  check_contrast(goal);
  goal.redrawn = [letter](PanelSize other) { return shown(letter, other); };
  return goal;
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
  const auto letter = std::make_shared<const Picture>(glyph_picture(text, font));
  return shown(letter, {columns, rows});
}

DisplayGoal glyph_goal(const std::string& text, int columns, int rows) {
  for (std::size_t k = 0; k + 1 < fonts_by_default.size(); ++k) {
    try {
      DisplayGoal goal = glyph_goal(text, find_font(fonts_by_default[k]), columns, rows);
      if (goal.whole) return goal;
    } catch (const InvalidInput&) {  // the last font says what is wrong
    }
  }
  return glyph_goal(text, find_font(fonts_by_default.back()), columns, rows);
}

}  // namespace kinetix::targets
