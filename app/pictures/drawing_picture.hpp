#pragma once

#include "targets/drawing/drawing.hpp"

namespace kinetix::app {

/// Draws what was understood from a drawing, as SVG. Walls are black with dots at their ends. Lines that are no walls
/// yet are grey. Faults are red: marked places, cells with an odd number of walls, and walls that are not connected to
/// most others.
std::string drawing_picture(const targets::DrawnWalls& walls);

}  // namespace kinetix::app
