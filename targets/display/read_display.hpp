#pragma once

#include "targets/display/display_goal.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {

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
