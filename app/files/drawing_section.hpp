#pragma once

#include "targets/document/section.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::app {

/// Returns the keys of a structure that is drawn: `drawing`, `unit`, `scale`, `join_mm`.
std::vector<targets::Key> drawing_keys();

/// Returns the keys of a drawing's size and joining: `unit`, `scale`, `join_mm`.
std::vector<targets::Key> drawing_size_keys();

/// Reads the walls of the drawing that a structure names, or the lines of its cuts, with a fault if the drawing is
/// refused.
/// @throws InvalidInput for a file that cannot be read
targets::DrawnWalls examine_drawn_structure(const targets::Section& structure);

}  // namespace kinetix::app
