#pragma once

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Flat sheet as a cutter reads it, mm, in the coordinates of all other files. A beam as wide as the kerf, with its
/// middle on the cuts, leaves the outline of bodies and bridges together.
struct CutDrawing {
  std::vector<std::vector<Eigen::Vector2d>>
      cuts;  ///< closed: holes clockwise, then outlines counter-clockwise
  std::vector<std::vector<Eigen::Vector2d>> slits;   ///< open lines to be cut before the closed ones
  std::vector<std::vector<Eigen::Vector2d>> scores;  ///< open lines of engraved numbers, and creases
  int pieces = 0;                                    ///< outlines: parts that are apart after the cut
  Eigen::Vector2d low, high;                         ///< corners of the least box about all cuts, mm

  double length_mm() const;  ///< of all cuts
};

/// Draws the cuts half a kerf outside of the sheet: convex corners stay sharp, others get the beam's radius. Numbers are
/// engraved within the walls, by the hinges that they name. Walls with no room for numbers have none.
/// A sheet that is drawn by its cuts has these lines as they are: half of the kerf is to each side of them.
/// @pre the process cuts sheets
CutDrawing cut_drawing(const PrintSheet& sheet);

}  // namespace kinetix::app
