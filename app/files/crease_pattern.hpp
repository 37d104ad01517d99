#pragma once

#include "model/lattice/origami/quad_mesh.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::app {

/// Lines of a crease pattern as a file lists them, y upwards.
struct CreaseLines {
  std::vector<targets::DrawnLine> lines;
  /// Letters of FOLD, one per line: M, V, B (boundary), C (cut), F (flat) or U (not known).
  std::vector<char> letters = {};
  /// Vertices with the numbers of the file, in its unit; empty if it has none
  std::vector<Eigen::Vector2d> vertices = {};
  double face_area = 0;                ///< sum of the faces of the file, in its unit; 0 if it lists none
  std::optional<double> unit_mm = {};  ///< of the numbers; empty if the file names none
};

/// Reads the creases of a FOLD file (the JSON of Demaine, Ku and Lang, 2016): `vertices_coords` in any plane,
/// `edges_vertices` or `faces_vertices`, and `edges_assignment`. Without these letters, the signs of
/// `edges_foldAngle` count. They come from the first flat crease pattern among the file and its `file_frames`.
CreaseLines read_fold_creases(const std::string& text);

/// Reads the creases of an SVG or DXF drawing by the colours of Origami Simulator. Mountains are red, valleys blue, flat
/// creases yellow or grey, and creases without a letter magenta. The boundary is black, and cuts are green.
/// @throws InvalidInput with a line for curves and other colours
CreaseLines read_drawn_creases(const targets::Drawing& drawing);

/// Reads the creases of a `.cp` file of ORIPA: a kind and two points per line, y downwards. Kind 1 is the boundary, 2
/// mountain, 3 valley, and others are auxiliary lines, which do not fold.
CreaseLines read_cp_creases(const std::string& text);

/// A crease pattern whose lines meet at vertices only.
struct CreaseMesh {
  model::PlanarGraph graph;
  std::vector<char> letters;            ///< of the edges
  std::vector<model::GraphFace> faces;  ///< counter-clockwise
  std::vector<int> number;              ///< of each vertex in the file; -1 for crossings and drawings
  /// Distance up to which ends were joined, in the unit of the file, if it is more than usual
  std::optional<double> joined = {};

  std::string name(int vertex) const;
  std::string edge_name(int edge) const;
  /// Returns the number of faces at each edge: 2 inside, 1 at the boundary.
  std::vector<int> faces_of_edges() const;
};

/// Makes a planar pattern of lines that may cross, overlap and end near each other. Of lines that overlap, the one with
/// the stronger letter counts: flat, unknown, boundary, mountain or valley, cut. Faces are merged across flat edges,
/// and straight vertices without other creases are left out.
/// @param is_wide whether ends are joined up to 3 % of the median line, instead of the distance for drawings.
/// @throws InvalidInput for creases that are both mountain and valley, or end inside a face. Patterns in several pieces
/// also throw.
CreaseMesh make_crease_mesh(const CreaseLines& lines, bool is_wide = false);

/// A pattern of quadrilaterals in columns and rows.
struct QuadGrid {
  model::QuadMesh mesh;        ///< `rising` and `level`: 1 for valleys, -1 for mountains, 0 if not known
  std::vector<int> vertex_of;  ///< vertex of the pattern for each vertex of the mesh
};

/// Finds the columns and rows of a pattern, from one of its corners.
/// @throws InvalidInput for a pattern with other faces, with other than four creases at an inner vertex, or without
/// columns and rows. The message counts what does not fit in the whole pattern.
QuadGrid find_quad_grid(const CreaseMesh& pattern);

}  // namespace kinetix::app
