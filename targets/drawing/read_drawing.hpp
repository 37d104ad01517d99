#pragma once

#include "model/lattice/planar/planar_graph.hpp"
#include "targets/document/document.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::targets {

/// The walls of a drawing: ends of lines within a thousandth of their mean length are one vertex, lines drawn twice are one
/// wall, and vertices as near to the outermost line of a side lie on it. Vertices from below, and from the left in a row; mm.
model::PlanarGraph walls_of(const Drawing& drawing);

/// The drawing that a document names, relative to its folder: a .dxf or .svg file. @throws InvalidInput at the
/// document's place for another ending, and naming the file for what cannot be read or has no lines
model::PlanarGraph read_drawing(const Node& path);

}  // namespace kinetix::targets
