#pragma once

#include "model/lattice/planar/planar_lattice.hpp"

namespace kinetix::model {

/// Returns a regular polygon with walls of length 1 around a middle, counter-clockwise, cell edges. @param first
/// angle of its first corner from the middle, rad
std::vector<Eigen::Vector2d> regular_polygon(int walls, double first, const Eigen::Vector2d& middle);

/// Regular hexagons with two walls of each upright; odd rows are shifted by half a hexagon.
extern const PlanarLattice honeycomb_lattice;

/// The honeycomb drawn as a wall of bricks: 2 x 1 rectangles with a vertex in the middle of their long sides.
extern const PlanarLattice brick_lattice;

/// Regular octagons with the squares between them (4.8.8).
extern const PlanarLattice octagon_lattice;

/// Rhombi whose walls along the rows and across them enclose the angle.
extern const PlanarLattice rhombus_lattice;

/// Returns columns x rows squares, as rhombi of 90 deg.
PlanarGraph square_graph(int columns, int rows);

/// Returns the regular lattices that files may name, in the order of the documentation. (Squares are separate,
/// model/lattice/square: only they have families that leave the plane.)
const std::vector<const PlanarLattice*>& planar_lattices();

/// Adds a lattice. @param lattice must live as long as the program
void add_planar_lattice(const PlanarLattice& lattice);

}  // namespace kinetix::model
