#pragma once

#include "model/base/invalid_input.hpp"
#include "model/lattice/lattice.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {

/// [columns, rows] of a panel of cells.
using PanelSize = std::array<int, 2>;

/// Least number of cells per side: leaves both a letter and a rest on each side.
inline constexpr int min_panel_side = 2;
/// Largest number of cells per side: keeps the search for a larger panel that shows a picture (whole_picture.hpp)
/// finite.
inline constexpr int max_panel_side = 1000;
/// Largest number of cells, 500 x 500: an upper limit on input. The app checks the memory of the machine.
inline constexpr int max_panel_cells = 250'000;

/// Least level (part of a cell's area, [0, 1]) of a letter cell: ink covers half of it. The slack treats cells that
/// are exactly half covered equally on both sides of a symmetric letter.
inline constexpr double letter_level = 0.5 - 1e-9;

/// Levels that an encoded display shows in its compressed state, one per cell.
struct DisplayGoal {
  int columns = 0, rows = 0;
  /// In [0, 1], 1 = letter, 0 = the rest; cell (i, j) at j * columns + i, i to the right and j upwards, as
  /// the cells of a structure: the top row of a picture has the largest j.
  std::vector<double> levels;
  /// Whether light parts of the picture are the letter. They must then appear bright, not as ink.
  bool inverted = false;
  bool is_text = false;  ///< text in a font; a reader must tell its parts apart.
  /// Whether the cells keep parts, holes and strokes of the source picture (whole_picture.hpp). True for goals of grey
  /// levels, and for rows, which are the picture.
  bool whole = true;
  /// Smallest larger panel of the same proportions that shows the picture whole. The shorter side grows cell by cell,
  /// the longer side in proportion, rounded. Empty for whole goals, and if no allowed panel shows the picture whole.
  std::optional<PanelSize> needed = {};
  /// Redraws the picture on another panel. @throws InvalidInput as check_panel and check_contrast
  std::function<DisplayGoal(PanelSize)> resized = {};

  double level(int i, int j) const { return levels[static_cast<std::size_t>(j) * columns + i]; }
  bool is_letter(int i, int j) const { return level(i, j) >= letter_level; }
  /// Whether every level is 0 or 1.
  bool is_binary() const;
  /// Returns one string per row, top row first: `1` for letter, `0` for the rest. rows_goal reads a binary goal back.
  std::vector<std::string> row_texts() const;
};

/// @throws InvalidInput for a panel under 2 x 2, over 1000 cells a side or over 250 000 cells
void check_panel(PanelSize size);

/// @throws InvalidInput if all levels are equal; the message names the needed panel, if any
void check_contrast(const DisplayGoal& goal);

/// @throws InvalidInput for a panel that check_panel refuses, and for levels that are all equal
/// @pre one level per cell, each in [0, 1]
DisplayGoal make_goal(PanelSize size, std::vector<double> levels);

/// Sets each level, [0, 1], to 1 if it is letter, else to 0.
std::vector<double> thresholded(std::vector<double> levels);

/// Checks one row, a string of `0` and `1`.
/// @throws InvalidInput for other characters or another length
void check_row(const std::string& row, std::size_t columns);

/// Makes a goal from rows drawn by hand, top row first.
/// @throws InvalidInput for no rows, rows that check_row refuses, and what make_goal refuses
DisplayGoal rows_goal(const std::vector<std::string>& rows);

/// Returns the levels of the panel's cells that have a place in the picture. On a panel of squares these are all
/// cells. On another lattice they are the cells by which it is drawn, which precede those of a closed boundary and
/// those between.
/// @pre the panel has the goal's columns and rows
std::vector<double> levels_of(const DisplayGoal& goal, const model::Lattice& panel);

/// Returns one value per cell of the picture, in the order of DisplayGoal::levels.
/// @param values of the panel's cells, as many as levels_of() gives and in that order
std::vector<double> in_order_of_goal(const DisplayGoal& goal, const model::Lattice& panel,
                                     const std::vector<double>& values);

/// Separation of the letter of a picture from the rest by a channel with one value per cell (formats.md).
struct DisplayScore {
  double letter = 0, rest = 0;  ///< means of the channel, in its unit
  /// d', dimensionless: (letter - rest) / sqrt(mean of the two variances). The root is at least 1e-5. Equal means give
  /// 0.
  double contrast = 0;
  /// Probability that a cell of the letter has a higher value than one of the rest; ties count half.
  double auc = 0.5;

  /// In the unit of the channel.
  double separation() const { return letter - rest; }
};

/// Scores a channel. Cells with a level of at least 0.5 belong to the letter. Differences of 1e-5, in the channel's
/// unit, count as none, since rounding makes no picture. NaN among the values gives NaN.
/// @pre as many values as levels, and both kinds of cells
DisplayScore display_score(const std::vector<double>& channel, const std::vector<double>& levels);

/// Computes Spearman's rank correlation of channel and levels, ties by mean ranks, in [-1, 1]. The result is 0 if all
/// values of one of them are equal. For pictures of grey levels.
double rank_correlation(const std::vector<double>& channel, const std::vector<double>& levels);

/// Returns every key of a `target:` section of kind display. The search interprets `channel`.
const KeyTable& display_target_keys();
/// Returns the key structure.cells of a display.
Key panel_cells_key();

/// Reads a `target:` section of kind display, which has one of three sources.
///   - `glyph: T`, optionally `font: DejaVu Sans Bold` (font_file.hpp) -> glyph_goal.
///   - `image: file.png`, relative to the document's folder, optionally `levels: 2 | grey` and `invert: true | false`
///     -> image_goal.
///   - `rows: ["0110", ...]`, top row first -> rows_goal.
/// @param cells the key structure.cells, [columns, rows]. If empty, a glyph has 10 columns per character and 10 rows.
/// An image then has 20 columns in its proportions, and rows have their size.
/// @param cell_shape distance of neighbouring columns over that of neighbouring rows: 2 for bricks.
/// @throws InvalidInput at its place for none or several sources, a key of another source, and what the goals refuse.
/// It also throws for cells that are not a multiple of the size of the rows.
DisplayGoal read_display(const Node& target, const std::optional<Node>& cells, double cell_shape = 1);

}  // namespace kinetix::targets
