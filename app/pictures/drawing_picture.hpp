#pragma once

#include "targets/drawing/cut_sheet.hpp"

namespace kinetix::app {

/// Draws what was understood from a drawing, as SVG. Walls are black with dots at their ends. Lines that are no walls
/// yet are grey. Faults are red: marked places, cells with an odd number of walls, and walls that are not connected to
/// most others.
std::string drawing_picture(const targets::DrawnWalls& walls);

/// Draws a sheet with cuts, as SVG: its pieces in shades of grey, cuts black, bridges red and creases blue.
std::string cut_picture(const targets::CutSheet& sheet);

}  // namespace kinetix::app
