#pragma once

#include "model/lattice/origami/origami_sheet.hpp"

namespace kinetix::app {

/// Crease pattern of a FOLD file (the JSON of Demaine, Ku and Lang, 2016) as a mesh that folds exactly.
struct OrigamiFile {
  model::QuadMesh mesh;        ///< in the file's unit; multipliers of the steepest crease: 1
  std::vector<int> vertex_of;  ///< number in the file of each vertex of the mesh
  /// Largest move of a vertex, mean edges. Vertices are moved so that each folds flat to the last digit.
  double moved = 0;
  std::optional<double> unit_mm = {};  ///< of the file, mm; empty if it names none
};

/// Limit of moves of vertices, mean edges. Files with larger moves are rejected; six digits leave less.
inline constexpr double most_moved = 1e-3;

/// Reads a crease pattern from `vertices_coords`, `faces_vertices`, `edges_vertices` and `edges_assignment` ("M",
/// "V", "B"). Without `edges_assignment`, the signs of `edges_foldAngle` count. They come from the file itself, or
/// from the first of its `file_frames` that has faces, in its `frame_unit`. Facets must be quadrilaterals in columns
/// and rows, at least 2 x 2. Angles of folded frames are not read: the crease pattern gives the folded shape, and the
/// tilt of the hinges gives how far it folds.
/// @param text of the file, `file` for messages
/// @throws InvalidInput for anything else, naming vertex, face or edge by its number in the file (from 0). Examples:
/// faces that are missing or not quadrilaterals, units that are not a length, and inner vertices of another degree
/// than four. Other examples: vertices that do not fold flat, and creases with incompatible mountains and valleys or
/// fold multipliers.
OrigamiFile parse_origami(const std::string& text, const std::string& file);
OrigamiFile read_origami_file(const std::string& file);

/// Returns the mesh of a pattern with its steepest crease tilted by `tilt`, rad, (0, pi/2).
model::QuadMesh tilted(const OrigamiFile& pattern, double tilt);

}  // namespace kinetix::app
