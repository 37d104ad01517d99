#pragma once

#include "model/lattice/planar/planar_graph.hpp"
#include "targets/document/document.hpp"

namespace kinetix::targets {

/// A straight line of a drawing from one point to the other, mm, y upwards.
using DrawnLine = std::array<Eigen::Vector2d, 2>;

/// Straight lines as a drawing has them: ends that belong together are near each other, not the same numbers,
/// and lines may be drawn twice.
using Drawing = std::vector<DrawnLine>;

/// Largest drawing, bytes (64 MiB): CAD programs are wordy.
inline constexpr std::size_t max_drawing_bytes = 64 << 20;
/// Most lines of a drawing: as many as the walls of the largest lattice that is read.
inline constexpr std::size_t max_drawn_lines = 1'000'000;

/// Reads the LINE, LWPOLYLINE and POLYLINE entities of a DXF file, in its unit ($INSUNITS; mm if it names none).
/// Entities on the paper of a layout, such as its frame, are not part of the drawing.
/// @throws InvalidInput without a place for curves (arcs, circles, splines, bulges), inserted blocks, and polylines
/// seen from below. Units that are not lengths, lines without a coordinate, and a file that is cut off also throw.
Drawing parse_dxf(const std::string& text);

/// Reads the line, polyline, polygon, rect and path elements of an SVG file, with their transforms. A user unit is
/// width / viewBox if the file gives it in mm, cm or inches, else a pixel of 1/96 inch. Hidden layers and elements
/// (display: none) are left out.
/// @throws InvalidInput without a place for anything but an SVG file, and for curves (circle, ellipse, round corners,
/// curved path commands). Unreadable numbers and units, an svg within the svg, and endlessly nested groups also throw.
Drawing parse_svg(const std::string& text);

/// Finds the walls of a drawing. Line ends within a thousandth of the mean line length are one vertex, and lines drawn
/// twice are one wall. Vertices that near to the outermost line of a side are moved onto it. Vertices are numbered
/// from below, and from the left in a row; mm.
model::PlanarGraph walls_of(const Drawing& drawing);

/// Reads the drawing that a document names, relative to its folder: a .dxf or .svg file. @throws InvalidInput at the
/// document's place for another ending, and naming the file for what cannot be read or has no lines
model::PlanarGraph read_drawing(const Node& path);

}  // namespace kinetix::targets
