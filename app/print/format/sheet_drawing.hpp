#pragma once

#include "app/print/sheet/print_sheet.hpp"

struct _cairo;

namespace kinetix::app {

/// Flat sheet as seen from above, mm, in the coordinates of all other files.
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

inline constexpr double digit_share = 0.65;    ///< digit's width over the height of letters, in common fonts
inline constexpr double capital_share = 0.75;  ///< digit's height over the height of letters, in common fonts

/// Returns the height of a hinge's number in drawings, mm.
double number_height_mm(const PrintSheet& sheet);

/// Returns the step of the grid on which areas are exact, mm: 1e-5, more if coordinates reach over 10 m.
double grid_step_mm(double reach_mm);

/// Draws each part as its shadow from above, on the grid of `grid_step_mm`.
SheetDrawing sheet_drawing(const PrintSheet& sheet);

/// Draws a sheet in a state from another side: all parts are in `bodies`, farthest first, and hinges are not marked.
/// @param state of the path, mm   @param turn rotation of the sheet before it is seen from above
SheetDrawing sheet_view(const PrintSheet& sheet, const model::State& state, const Eigen::Matrix3d& turn);

/// Replaces what XML and HTML read as marks.
std::string escape_marks(std::string_view text);

/// Draws a page as PDF, the same bytes each time. A page larger than A4 gets a line to measure below the drawing.
/// @param size_mm of the drawing   @param draw draws in mm, y down
std::string pdf_page(const Eigen::Vector2d& size_mm, const std::function<void(_cairo*)>& draw);

/// Walls as strips of card to be cut out, scored and glued by hand, side by side on one page, mm, y up. A strip is a
/// wall in its own plane from vertex to vertex. Its hinge is a line to score. A strip ends in a tab at a vertex with
/// other walls. The tab is folded about the vertex and glued to the next wall counter-clockwise. Tabs are half as long
/// as the distance from vertex to nearest hinge, or half the wall's height if that is less.
struct Strips {
  struct Label {
    Eigen::Vector2d place;  ///< middle of its foot, mm
    std::string text;
    double height;  ///< font size of its letters, mm
  };

  std::vector<std::vector<Eigen::Vector2d>> cuts;                  ///< outlines, one per strip
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> folds;  ///< hinges and tabs
  std::vector<Label> numbers;   ///< of hinges, as in sheet_drawing, next to the score
  std::vector<Label> vertices;  ///< at both ends, within the wall
  Eigen::Vector2d size;         ///< of the page, mm
};

Strips strips(const PrintSheet& sheet);

}  // namespace kinetix::app
