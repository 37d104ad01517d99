#pragma once

#include "model/lattice/planar/planar_graph.hpp"
#include "targets/document/document.hpp"

namespace kinetix::targets {

/// A straight line of a drawing, y upwards, in the unit of the drawing's numbers.
struct DrawnLine {
  Eigen::Vector2d from, to;
  int line = 0;    ///< of the file, from 1; 0: not known
  int colour = 0;  ///< of its stroke, 0xRRGGBB; black if the file has none
  int curve = -1;  ///< index in Drawing::curves for a chord; -1 for a straight line
};

/// Visible lines of a drawing. Curves are replaced by chords. Blocks, symbols and transforms are applied.
struct Drawing {
  std::vector<DrawnLine> lines;
  std::vector<std::string> curves;  ///< names of the curved elements, such as "circle"
  double unit_mm = 1;               ///< of the numbers
  bool has_unit = false;            ///< whether the file determines the unit, which is assumed otherwise
  std::string unit_source;  ///< part of the file that gives the unit, or the assumption and its reason
};

/// Largest drawing, bytes (64 MiB): CAD programs are wordy.
inline constexpr std::size_t max_drawing_bytes = 64 << 20;
/// Most lines of a drawing: as many as the walls of the largest lattice that is read.
inline constexpr std::size_t max_drawn_lines = 1'000'000;

/// Reads the visible lines and curves of a DXF file in its model space: LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE,
/// ELLIPSE, SPLINE, 3DFACE, and INSERT of blocks of them. Layers that are off or frozen are left out. The unit is that
/// of $INSUNITS, and mm is assumed without it.
/// @throws InvalidInput with a line for missing blocks, lines that are not flat, meshes, and incomplete entities. Files
/// that are cut off also throw.
Drawing parse_dxf(const std::string& text);

/// Reads the visible lines and curves of an SVG file: line, polyline, polygon, rect, circle, ellipse, path, and use of
/// them. Style sheets, transforms and nested svg elements are applied.
/// The unit follows from width, height and viewBox. A px is 1/96 inch, in files of Illustrator 1/72 inch, and in files
/// of Inkscape before 0.92 1/90 inch. Lengths without a unit are assumed to be px.
/// @throws InvalidInput with a line for unreadable numbers, units and transforms, and for endlessly nested elements
Drawing parse_svg(const std::string& text);

/// Unit and joining of a drawing, as a document gives them.
struct DrawingSettings {
  std::optional<double> unit_mm = {};  ///< of the drawing's numbers, instead of the file's
  double scale = 1;                    ///< ratio of the sheet to the drawing
  std::optional<double> join_mm = {};  ///< distance in which ends are joined
  bool are_cuts = false;               ///< lines are cuts: curves are taken as chords, and no walls are made
};

/// Walls that were understood from a drawing. A drawing that is refused has what was understood up to the fault.
struct DrawnWalls {
  std::string file;              ///< path of the drawing
  std::vector<DrawnLine> lines;  ///< mm
  model::PlanarGraph graph;      ///< walls, mm; vertices from below, and from the left in a row; none of cuts
  std::string unit;              ///< unit of the drawing's numbers and its source
  std::optional<InvalidInput> fault;   ///< reason to refuse the drawing
  std::vector<Eigen::Vector2d> marks;  ///< places of the fault, in the unit of `lines`
};

/// Reads the walls of the DXF or SVG file that a document names, relative to its folder.
/// @throws InvalidInput at the document's place for another ending, and naming the file if it cannot be read. Other
/// faults are returned with what was understood.
DrawnWalls examine_drawing(const Node& path, const DrawingSettings& settings);

/// Reads walls as examine_drawing(). @throws InvalidInput for its fault
DrawnWalls read_drawing(const Node& path, const DrawingSettings& settings = {});

}  // namespace kinetix::targets
