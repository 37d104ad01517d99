#pragma once

#include <optional>
#include <string>

#include "model/lattice/origami/origami_sheet.hpp"

namespace kinetix::app {

/// A crease pattern of a FOLD file (the JSON of Demaine, Ku and Lang, 2016) as a mesh that folds exactly.
struct OrigamiFile {
  model::QuadMesh mesh;        ///< in the file's unit; multipliers of the steepest crease: 1
  std::vector<int> vertex_of;  ///< number in the file of each vertex of the mesh
  /// How far vertices were moved so that every vertex folds flat to the last digit, mean edges.
  double moved = 0;
  std::optional<double> unit_mm = {};  ///< of the file, mm; nothing where it names none
};

/// Files are refused where vertices would have to move by more than this, mean edges: six digits leave less.
inline constexpr double most_moved = 1e-3;

/// From `vertices_coords`, `faces_vertices`, `edges_vertices` and `edges_assignment` ("M", "V", "B"; where it is missing the
/// signs of `edges_foldAngle`) of the file itself, or of the first of its `file_frames` that has faces, in its `frame_unit`.
/// Facets must be
/// quadrilaterals in columns and rows, at least 2 x 2; what they look like folded follows from the crease pattern, how far
/// from the tilt of the hinges: angles of folded frames are not read.
/// @param text of the file, `file` for messages
/// @throws InvalidInput, naming vertex, face or edge by its number in the file (from 0), for anything else: faces that are
/// missing or no quadrilaterals, units that are no length, inner vertices of another degree than four, vertices that do not fold flat, creases
/// whose mountains and valleys or whose fold multipliers do not go together
OrigamiFile parse_origami(const std::string& text, const std::string& file);
OrigamiFile read_origami_file(const std::string& file);

/// The same with its steepest crease tilted by `tilt`, rad, (0, pi/2).
model::QuadMesh tilted(const OrigamiFile& pattern, double tilt);

}  // namespace kinetix::app
