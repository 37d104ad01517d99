#pragma once

#include <functional>

#include "model/lattice/planar/planar_graph.hpp"

namespace kinetix::model {

/// Drawings of regular lattices with walls of length 1, lowest and leftmost vertex first. All faces are even.

/// columns x rows squares.
PlanarGraph square_graph(int columns, int rows);
/// columns x rows rhombi, sheared so that walls along the rows and across them enclose `angle`, rad, in (0,
/// pi).
PlanarGraph rhombus_graph(int columns, int rows, double angle);
/// columns x rows hexagons with two walls of each upright, rows shifted by half a hexagon in turn.
PlanarGraph honeycomb_graph(int columns, int rows);
/// The honeycomb drawn as a wall of bricks: 2 x 1 rectangles with a vertex in the middle of their long sides.
PlanarGraph brick_graph(int columns, int rows);
/// columns x rows octagons with the squares between them (4.8.8).
PlanarGraph octagon_graph(int columns, int rows);

/// What is left of a graph where all corners of a face must lie in a region: the faces inside, in the largest
/// piece that hangs together by walls. @throws InvalidInput where no face lies inside
PlanarGraph trimmed(const PlanarGraph& graph, const std::function<bool(const Eigen::Vector2d&)>& inside);

}  // namespace kinetix::model
