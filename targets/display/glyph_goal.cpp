#include "targets/display/glyph_goal.hpp"

#include <algorithm>
#include <memory>

#include "targets/display/glyph_picture.hpp"
#include "targets/display/whole_picture.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::targets {
namespace {

Window panel_over(const Picture& letter, PanelSize size, double cell_shape) {
  const int margin = std::min(size[0], size[1]) < least_side_with_margin ? 0 : 1;
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
  goal.redrawn = [=](PanelSize other) { return shown(letter, other, cell_shape); };
  return goal;
}

void check_length(const std::string& text) {
  if (text.empty()) throw InvalidInput("is empty; give a letter or a short word");
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
