#pragma once

#include "model/lattice/origami/origami_sheet.hpp"

namespace kinetix::app {

/// Crease pattern of a file as a mesh that folds exactly.
struct OrigamiFile {
  model::QuadMesh mesh;  ///< in the file's unit; multipliers of the steepest crease: 1
  /// Largest move of a vertex, mean edges. Vertices are moved so that each folds flat to the last digit.
  double moved = 0;
  std::vector<std::string> notes = {};  ///< changes to the content of the file, one sentence each
  std::optional<double> unit_mm = {};   ///< of the file, mm; empty if it names none
};

/// Reads a crease pattern: FOLD, SVG, DXF or `.cp`, by its ending (crease_pattern.hpp). Facets must be quadrilaterals
/// in columns and rows, at least 2 x 2, after facets were merged across flat creases. Mountains and valleys that are
/// not given follow from the angles. Fold angles and opacities are not read: the pattern gives the folded shape, and
/// the tilt of the hinges gives how far it folds.
/// @param text of the file, `file` for its ending and for messages
/// @throws InvalidInput for anything else. It names vertices and edges by their numbers in the file (from 0), or by
/// their place. Examples: patterns that are not such a mesh, in one message about the whole file, and vertices that do
/// not fold flat within `model::most_moved`.
OrigamiFile parse_origami(const std::string& text, const std::string& file);
OrigamiFile read_origami_file(const std::string& file);

/// Returns the mesh of a pattern with its steepest crease tilted by `tilt`, rad, (0, pi/2).
model::QuadMesh tilted(const OrigamiFile& pattern, double tilt);

}  // namespace kinetix::app
