#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace kinetix::targets {

/// A straight line of a drawing from one point to the other, mm, y upwards.
using DrawnLine = std::array<Eigen::Vector2d, 2>;

/// Straight lines as a drawing has them: ends that belong together are near each other, not the same numbers,
/// and lines may be drawn twice.
using Drawing = std::vector<DrawnLine>;

/// Bytes of a drawing, 64 MiB: CAD programs are wordy.
inline constexpr std::size_t max_drawing_bytes = 64 << 20;
/// Lines of a drawing: as many as the walls of the largest lattice that is read.
inline constexpr std::size_t max_drawn_lines = 1'000'000;

/// LINE, LWPOLYLINE and POLYLINE entities of a DXF file, in its unit ($INSUNITS; mm where it names none); what stands
/// on the paper of a layout, such as its frame, is no part of the drawing.
/// @throws InvalidInput without a place for curves (arcs, circles, splines, bulges), blocks that are inserted,
/// polylines seen from below, units that are no length, lines without a coordinate, and a file that is cut off
Drawing parse_dxf(const std::string& text);

/// line, polyline, polygon, rect and path elements of an SVG file, with their transforms. A user unit is
/// width / viewBox where the file says so in mm, cm or inches, else a pixel of 1/96 inch. Hidden layers and elements
/// (display: none) are left out.
/// @throws InvalidInput without a place for what is not an SVG file, for curves (circle, ellipse, round corners,
/// curved path commands), for numbers and units that it cannot read, for an svg within the svg, and for groups without
/// end in each other
Drawing parse_svg(const std::string& text);

}  // namespace kinetix::targets
