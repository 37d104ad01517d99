#pragma once

#include <cstdint>
#include <vector>

#include "targets/display/display_goal.hpp"

namespace kinetix::targets {

/// Ink on paper, much finer than the cells of a panel.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> ink;  ///< 0 = paper, 255 = ink; row after row from the top left
};

/// An upright rectangle in pixels, x to the right and y down from the top left corner of a picture. It may
/// reach beyond the picture, where there is no ink.
struct Window {
  double left = 0, right = 0, top = 0, bottom = 0;
};

/// Returns the window of the whole picture.
Window frame(const Picture& picture);

/// Computes the part of each cell's area that ink covers if the panel fills the window, [0, 1]. It is the mean of the
/// pixels under the cell, each weighted by its part inside. Cells are in the order of DisplayGoal::levels.
/// @pre left < right, top < bottom
std::vector<double> ink_coverage(const Picture& picture, const Window& window, PanelSize size);

}  // namespace kinetix::targets
