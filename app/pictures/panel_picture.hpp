#pragma once

#include <string>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

enum class PictureFormat { svg, png };

struct PictureOptions {
  PictureFormat format = PictureFormat::svg;
  double pixels_per_mm = 4;   ///< resolution of a PNG; an SVG is to scale in mm
  double most_pixels = 4000;  ///< largest side of a PNG, px; larger images take seconds and show no more
  bool hinges = false;        ///< hinge map: dots on the walls, coloured by distance from the middle
};

/// Draws a panel as a photograph of the print from above. Walls are black on white and to scale, with the structure's y
/// upwards. The margin is half a cell on each side. @return the file's content
/// @throws std::runtime_error if the picture cannot be drawn, such as for a state that is not finite
std::string panel_picture(const model::Linkage& panel, const model::State& state,
                          const PictureOptions& options);

}  // namespace kinetix::app
