#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Every wall as a strip of card to be cut out, scored and glued by hand, side by side on one page, mm, y up. A strip is a
/// wall in its own plane from vertex to vertex, its hinge a line to score. Where it meets other walls it ends in a tab:
/// folded about the vertex, the tab is glued to the next wall counter-clockwise. Tabs are half as long as the way from
/// vertex to nearest hinge, or half the wall's height where that is less.
struct Strips {
  struct Label {
    Eigen::Vector2d place;  ///< of the middle of its foot, mm
    std::string text;
    double height;  ///< of its letters' font, mm
  };

  std::vector<std::vector<Eigen::Vector2d>> cuts;                  ///< outlines, one of each strip
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> folds;  ///< hinges and tabs
  std::vector<Label> numbers;   ///< of hinges, as sheet_drawing has them, beside the score
  std::vector<Label> vertices;  ///< at both ends, within the wall
  Eigen::Vector2d size;         ///< of the page, mm
};

Strips strips(const PrintSheet& sheet);

}  // namespace kinetix::app
