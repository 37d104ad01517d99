#pragma once

#include <optional>

#include "targets/display/display_goal.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {

/// Every key of a `target:` section of kind display. What `channel` means is for the search.
const KeyTable& display_target_keys();
/// The key structure.cells of a display.
Key panel_cells_key();

/// A `target:` section of kind display: one of
///   - `glyph: T`, optionally `font: DejaVu Sans Bold` (font_file.hpp) -> glyph_goal,
///   - `image: file.png`, relative to the document's folder, optionally `levels: 2 | grey` and
///     `invert: true | false` -> image_goal,
///   - `rows: ["0110", ...]`, top row first -> rows_goal.
/// @param cells the key structure.cells, [columns, rows]; nothing: 10 columns a character and 10 rows for a
/// glyph, 20 columns in the image's proportions for an image, the size of the rows for rows
/// @param cell_shape distance of neighbouring columns over that of neighbouring rows: 2 of bricks
/// @throws InvalidInput for none or several of these, a key that belongs to another of them, cells that
/// are not the size of the rows, and what the goals refuse, each at its place
DisplayGoal read_display(const Node& target, const std::optional<Node>& cells, double cell_shape = 1);

}  // namespace kinetix::targets
