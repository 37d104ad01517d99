#pragma once

#include <string>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

enum class PictureFormat { svg, png };

struct PictureOptions {
  PictureFormat format = PictureFormat::svg;
  double pixels_per_mm = 4;  ///< of a PNG; an SVG is to scale in mm
  double most_pixels =
      4000;  ///< a side of a PNG: of large panels a mm has fewer. More take seconds and show no more
  bool hinges = false;  ///< the hinge map: dots on the walls, by how far they sit from the middle
};

/// A panel in a state as one would photograph the print from above: walls black on white, to scale, upright
/// as the structure's y. @return the file's content, with a margin of half a cell all round
/// @throws std::runtime_error where the picture cannot be drawn, such as for a state that is not finite
std::string panel_picture(const model::Linkage& panel, const model::State& state,
                          const PictureOptions& options);

}  // namespace kinetix::app
