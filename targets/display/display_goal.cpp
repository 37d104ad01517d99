#include "targets/display/display_goal.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

std::string panel_text(PanelSize size) {
  return "a panel of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " cells";
}

/// Gives each cell the level of the cell of `goal` that contains its middle. The result is whole if all cells of
/// `goal` become blocks of the same size.
DisplayGoal enlarged(const DisplayGoal& goal, PanelSize size) {
  std::vector<double> levels;
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i)
      levels.push_back(
          goal.level((2 * i + 1) * goal.columns / (2 * size[0]), (2 * j + 1) * goal.rows / (2 * size[1])));
  DisplayGoal out = make_goal(size, std::move(levels));
  out.whole = size[0] % goal.columns == 0 && size[1] % goal.rows == 0;
  out.redrawn = [own = goal](PanelSize other) { return enlarged(own, other); };
  return out;
}

}  // namespace

bool DisplayGoal::is_binary() const {
  return std::all_of(levels.begin(), levels.end(), [](double level) { return level == 0 || level == 1; });
}

std::vector<std::string> DisplayGoal::row_texts() const {
  std::vector<std::string> texts;
  for (int j = rows - 1; j >= 0; --j) {
    std::string& text = texts.emplace_back();
    for (int i = 0; i < columns; ++i) text += is_letter(i, j) ? '1' : '0';
  }
  return texts;
}

void check_panel(PanelSize size) {
  const auto [shorter, longer] = std::minmax(size[0], size[1]);
  if (shorter < min_panel_side) throw InvalidInput(panel_text(size) + " is too small; give at least 2 x 2");
  if (longer > max_panel_side || static_cast<long>(shorter) * longer > max_panel_cells)
    throw InvalidInput(panel_text(size) + " is too large; at most " + std::to_string(max_panel_side) +
                       " cells a side and " + std::to_string(max_panel_cells) + " in all are allowed");
}

void check_contrast(const DisplayGoal& goal) {
  const auto [least, most] = std::minmax_element(goal.levels.begin(), goal.levels.end());
  if (*least < *most) return;
  const std::string help =
      goal.whole    ? "both must occur"
      : goal.needed ? "the smallest panel of these proportions that shows the picture whole is [" +
                          std::to_string((*goal.needed)[0]) + ", " + std::to_string((*goal.needed)[1]) + "]"
                    : "no panel of these proportions that is allowed shows the picture whole";
  throw InvalidInput("every cell is " + std::string(*least >= letter_level ? "letter" : "rest") +
                     ", so that there is nothing to tell apart; " + help);
}

DisplayGoal make_goal(PanelSize size, std::vector<double> levels) {
  check_panel(size);
  assert(levels.size() == static_cast<std::size_t>(size[0]) * size[1]);
  DisplayGoal goal;
  goal.columns = size[0];
  goal.rows = size[1];
  goal.levels = std::move(levels);
  check_contrast(goal);
  return goal;
}

std::vector<double> thresholded(std::vector<double> levels) {
  for (double& level : levels) level = level >= letter_level ? 1 : 0;
  return levels;
}

void check_row(const std::string& row, std::size_t columns) {
  const std::size_t wrong = row.find_first_not_of("01");
  if (wrong != std::string::npos)
    throw InvalidInput(in_ticks(row) +
                       " holds more than 0 and 1; give 1 for a cell of the letter and 0 for the rest");
  if (row.size() != columns)
    throw InvalidInput("has " + std::to_string(row.size()) + " cells, and the first row has " +
                       std::to_string(columns) + "; give rows of equal length");
}

DisplayGoal rows_goal(const std::vector<std::string>& rows) {
  if (rows.empty()) throw InvalidInput("holds no rows; give rows of 0 and 1, top row first");
  std::vector<double> levels;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    check_row(*row, rows[0].size());
    for (const char c : *row) levels.push_back(c == '1' ? 1 : 0);
  }
  DisplayGoal goal =
      make_goal({static_cast<int>(rows[0].size()), static_cast<int>(rows.size())}, std::move(levels));
  goal.redrawn = [own = goal](PanelSize size) { return enlarged(own, size); };
  return goal;
}

}  // namespace kinetix::targets
