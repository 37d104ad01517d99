#pragma once

#include "model/lattice/planar/planar_graph.hpp"
#include "targets/document/document.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::targets {

/// Finds the walls of a drawing. Line ends within a thousandth of the mean line length are one vertex, and lines drawn
/// twice are one wall. Vertices that near to the outermost line of a side are moved onto it. Vertices are numbered
/// from below, and from the left in a row; mm.
model::PlanarGraph walls_of(const Drawing& drawing);

/// Reads the drawing that a document names, relative to its folder: a .dxf or .svg file. @throws InvalidInput at the
/// document's place for another ending, and naming the file for what cannot be read or has no lines
model::PlanarGraph read_drawing(const Node& path);

}  // namespace kinetix::targets
