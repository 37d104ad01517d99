#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/base/invalid_input.hpp"

namespace kinetix::targets {

/// [columns, rows] of a panel of cells.
using PanelSize = std::array<int, 2>;

/// Cells a side: the fewest that leave both a letter and a rest on each side.
inline constexpr int min_panel_side = 2;
/// Cells a side: keeps the search for a larger panel that shows a picture (whole_picture.hpp) finite.
inline constexpr int max_panel_side = 1000;
/// Cells in all, 500 x 500: an upper limit on what is read; app checks what the machine's memory holds.
inline constexpr int max_panel_cells = 250'000;

/// A cell is letter where its level (part of its area, [0, 1]) is at least this: ink covers half of it. The
/// slack keeps cells that are covered by exactly half alike on both sides of a symmetric letter.
inline constexpr double letter_level = 0.5 - 1e-9;

/// What an encoded display shows once it is compressed: one level a cell.
struct DisplayGoal {
  int columns = 0, rows = 0;
  /// In [0, 1], 1 = letter, 0 = the rest; cell (i, j) at j * columns + i, i to the right and j upwards, as
  /// the cells of a structure: the top row of a picture has the largest j.
  std::vector<double> levels;
  /// Whether light parts of the picture are the letter: then what is bright is to be seen bright, not as ink.
  bool inverted = false;
  bool is_text = false;  ///< letters of a font, whose parts a reader has to tell apart
  /// Whether the cells keep parts, holes and strokes of the picture they are taken from (whole_picture.hpp);
  /// true for goals of grey levels, and for rows, which are the picture.
  bool whole = true;
  /// Unless whole: the smallest larger panel of the same proportions that shows the picture whole: the
  /// shorter side grows cell by cell and the longer side in proportion, rounded. Nothing where none that is
  /// allowed does.
  std::optional<PanelSize> needed = {};
  /// The same picture on another panel. @throws InvalidInput as check_panel and check_contrast
  std::function<DisplayGoal(PanelSize)> redrawn = {};

  double level(int i, int j) const { return levels[static_cast<std::size_t>(j) * columns + i]; }
  bool is_letter(int i, int j) const { return level(i, j) >= letter_level; }
  /// Whether every level is 0 or 1.
  bool is_binary() const;
  /// One string a row, top row first: `1` for letter, `0` for the rest. rows_goal reads a binary goal back.
  std::vector<std::string> row_texts() const;
};

/// @throws InvalidInput for a panel under 2 x 2, over 1000 cells a side or over 250 000 cells
void check_panel(PanelSize size);

/// @throws InvalidInput where all levels are alike; the message names the needed panel, where there is one
void check_contrast(const DisplayGoal& goal);

/// @throws InvalidInput for a panel that check_panel refuses, and for levels that are all alike
/// @pre one level a cell, each in [0, 1]
DisplayGoal make_goal(PanelSize size, std::vector<double> levels);

/// 1 for each level, [0, 1], that is letter, 0 for the others.
std::vector<double> thresholded(std::vector<double> levels);

/// One row as a string of `0` and `1`.
/// @throws InvalidInput for other characters or another length
void check_row(const std::string& row, std::size_t columns);

/// A goal drawn by hand, top row first.
/// @throws InvalidInput for no rows, rows that check_row refuses, and what make_goal refuses
DisplayGoal rows_goal(const std::vector<std::string>& rows);

}  // namespace kinetix::targets
