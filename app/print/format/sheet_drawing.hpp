#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// The flat sheet as seen from above, mm, in the coordinates of all other files.
struct SheetDrawing {
  struct Part {
    std::string name;
    std::vector<std::vector<Eigen::Vector2d>> rings;  ///< outlines counter-clockwise, holes clockwise, mm
  };
  struct Hinge {
    int number = 0;         ///< from 1, the hinge's position in the design plus one
    Eigen::Vector2d place;  ///< mm
    double rod_radius = 0;  ///< of a pin, mm; 0: none
  };

  std::vector<Part> bodies, soft;
  std::vector<Hinge> hinges;
  Eigen::Vector2d low, high;  ///< corners of the least box about all parts, mm
};

inline constexpr double digit_share =
    0.65;  ///< of a digit's width over the height of letters, in common fonts
inline constexpr double capital_share = 0.75;  ///< of a digit's height, likewise

/// Of a hinge's number in drawings, mm.
double number_height_mm(const PrintSheet& sheet);

/// Each part by its shadow, to 1e-5 mm.
SheetDrawing sheet_drawing(const PrintSheet& sheet);

}  // namespace kinetix::app
