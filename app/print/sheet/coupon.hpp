#pragma once

#include "app/print/sheet/print_sheet.hpp"
#include "model/solids/polyhedron.hpp"

namespace kinetix::app {

/// Makes a test piece that shows the least clearance of a printer. It has pins with the process's rod and gaps of 0.1
/// to 0.6 mm per side, each leaning by 0, 30 and 60 degrees. Raised numbers on the forks give the gap, mm. Columns run
/// from 0.1 to 0.6 mm, rows from upright to 60 degrees. Each hinge joins two separate bodies.
/// Processes that cut sheets have bridges of 0.4 to 1.6 mm instead, each between two tabs of one piece.
/// @param bed_mm of the printer: a coupon that it does not hold is cut into tiles between its hinges.
/// @throws BedTooSmall for a bed that does not hold each hinge
PrintSheet make_coupon(const model::Process& process, const std::optional<Eigen::Vector2d>& bed_mm = {});

/// Flat convex face of a solid, with the place of text on it. mm
struct TextFace {
  Eigen::Vector3d middle;     ///< of the text, on the face
  Eigen::Vector3d right, up;  ///< unit vectors, square to each other, right x up outwards
  double pixel_mm = 0.8;      ///< edge of a letter's squares, > 0: letters are 3 wide and 5 high
  double raised_mm = 0.4;     ///< over the face, > 0
};

/// Raises digits and points from a face. The solid stays one closed surface. Its volume grows by pixel_mm^2 raised_mm
/// for each square of the digits' seven strokes.
/// @param text of 0 to 9 and '.'; not empty.
/// @throws std::invalid_argument for other text, without a face there, and for a face smaller than the text
void raise_text(std::string_view text, const TextFace& face, model::Polyhedron& solid);

/// Counts the squares that a text raises.
int raised_squares(std::string_view text);

}  // namespace kinetix::app
