#pragma once

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"
#include "targets/drawing/cut_sheet.hpp"

namespace kinetix::app {

enum class PictureFormat { svg, png };

struct PictureOptions {
  PictureFormat format = PictureFormat::svg;
  double pixels_per_mm = 4;  ///< resolution of a PNG; an SVG is to scale in mm
  double max_pixels = 4000;  ///< largest side of a PNG, px; larger images take seconds and show no more
  bool hinges = false;       ///< hinge map: dots on the walls, coloured by distance from the middle
};

/// Draws a panel as a photograph of the print from above. Walls are black on white and to scale, with the structure's y
/// upwards. The margin is half a cell on each side. @return the file's content
/// @throws std::runtime_error if the picture cannot be drawn, such as for a state that is not finite
std::string panel_picture(const model::Linkage& panel, const model::State& state,
                          const PictureOptions& options);

struct FarViewOptions {
  double pixels_per_cell = 12;  ///< px per cell edge, > 0
  /// Standard deviation of the Gaussian blur from the distance, cell edges.
  double blur_in_cells = 0.6;
  /// Standard deviation of the neighbourhood whose mean light is subtracted, cell edges; 0: none. An eye adapts so.
  double surroundings_in_cells = 0;
  /// Stretches the light between its 2nd and 98th percentile, because an eye adapts. Otherwise luminance is true. A
  /// page must mark such a picture as enhanced.
  bool enhanced = false;
  /// Negative picture and white margin, for programs that read dark ink on white paper.
  bool negative = false, on_white = false;
};

/// Draws a planar panel in front of a lamp, seen from a distance. The light through its openings is blurred to about a
/// cell and divided by the panel's blurred outline. Full light is white and no light is black (luminance in sRGB). The
/// margin of two cells is black. @return a PNG @throws std::runtime_error for a state that is not finite
std::string far_view(const model::Linkage& panel, const model::State& state,
                     const FarViewOptions& options = {});

/// Draws what was understood from a drawing, as SVG. Walls are black with dots at their ends. Lines that are no walls
/// yet are grey. Faults are red: marked places, cells with an odd number of walls, and walls that are not connected to
/// most others.
std::string drawing_picture(const targets::DrawnWalls& walls);

/// Draws a sheet with cuts, as SVG: its pieces in shades of grey, cuts black, bridges red and creases blue.
std::string cut_picture(const targets::CutSheet& sheet);

}  // namespace kinetix::app
