#pragma once

#include "app/print/sheet/print_sheet.hpp"

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

/// Flat sheet as a cutter reads it, mm, in the coordinates of all other files. A beam as wide as the kerf, with its
/// middle on the cuts, leaves the outline of bodies and bridges together.
struct CutDrawing {
  std::vector<std::vector<Eigen::Vector2d>>
      cuts;  ///< closed: holes clockwise, then outlines counter-clockwise
  std::vector<std::vector<Eigen::Vector2d>> scores;  ///< open lines of engraved numbers
  int pieces = 0;                                    ///< outlines: parts that are apart after the cut
  Eigen::Vector2d low, high;                         ///< corners of the least box about all cuts, mm

  double length_mm() const;  ///< of all cuts
};

/// Draws the cuts half a kerf outside of the sheet: convex corners stay sharp, others get the beam's radius. Numbers are
/// engraved within the walls, by the hinges that they name. Walls with no room for numbers have none.
/// @pre the process cuts sheets
CutDrawing cut_drawing(const PrintSheet& sheet);

inline constexpr double digit_share = 0.65;    ///< digit's width over the height of letters, in common fonts
inline constexpr double capital_share = 0.75;  ///< digit's height over the height of letters, in common fonts

/// Returns the height of a hinge's number in drawings, mm.
double number_height_mm(const PrintSheet& sheet);

/// Draws each part as its shadow from above, to 1e-5 mm.
SheetDrawing sheet_drawing(const PrintSheet& sheet);

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
