#include "model/lattice/planar/lattices/honeycomb.hpp"

#include <cmath>

#include "model/base/angle.hpp"
#include "model/lattice/planar/lattices/polygon.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> honeycomb_corners(int i, int j, double) {
  return regular_polygon(6, pi / 2, {std::sqrt(3.0) * (i + 0.5 * odd_row(j)), 1.5 * j});
}

}  // namespace

// Name, meaning, honeycomb_corners of a cell.
const PlanarLattice honeycomb_lattice = {
    "honeycomb", "regular hexagons, two walls of each upright, odd rows shifted by half a hexagon",
    honeycomb_corners};

}  // namespace kinetix::model
