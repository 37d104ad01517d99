#include "model/lattice/planar/lattices/rhombus.hpp"

#include <cmath>

#include "model/base/angle.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> rhombus_corners(int i, int j, double angle) {
  const Vector2d along(1, 0), across(std::cos(angle), std::sin(angle)), at = i * along + j * across;
  return {at, at + along, at + along + across, at + across};
}

}  // namespace

// Name, meaning, rhombus_corners of a cell, whether the angle shapes it.
const PlanarLattice rhombus_lattice = {
    "rhombus", "rhombi whose walls along the rows and across them enclose `angle_deg`", rhombus_corners,
    true};

PlanarGraph square_graph(int columns, int rows) {
  return lattice_graph(rhombus_lattice, columns, rows, pi / 2);
}

}  // namespace kinetix::model
